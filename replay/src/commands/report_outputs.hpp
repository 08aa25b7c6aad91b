// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "base/standard_streams.hpp"
#include "report/output_file.hpp"

namespace dch::cli {

/// The report of a command as JSON, as a page and as a table, each where it was asked for. Files are opened
/// before the work, so that one that cannot be written is refused at once, and appear together after it.
class ReportOutputs {
 public:
  /// @param report, page paths, empty for none
  /// @throws as open_output
  ReportOutputs(std::string report, std::string page)
      : report_(std::move(report)),
        page_(std::move(page)),
        json_file_(open_output(report_)),
        page_file_(open_output(page_)) {}

  /// @throws trajectory::FileError
  template <class Report>
  void write(const Report& report) {
    if (json_file_) json_file_->write(render_json(report));
    if (page_file_) page_file_->write(render_html(report));
    if (json_file_) json_file_->commit();
    if (page_file_) page_file_->commit();
  }

  /// The table, and where the files are. @param what the command calls what else it wrote, to the path `data`
  template <class Report>
  void print(const Report& report, const char* what, const std::string& data) const {
    write_output(render_table(report));
    for (const auto& [name, path] :
         {std::pair(what, &data), std::pair("report", &report_), std::pair("page", &page_)})
      if (!path->empty()) print_output("  {:<16}{}\n", name, *path);
  }

 private:
  std::string report_, page_;
  std::unique_ptr<OutputFile> json_file_, page_file_;
};

}  // namespace dch::cli
