// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace dch::trajectory {

/// A file that appears under its name only once it is complete: until commit() it is written beside its place
/// under a temporary name, which the destructor removes. Whatever fails before, a file that has the name
/// stays as it is.
///
/// Symbolic links are followed: the file that they lead to is the one that is written. A file that is
/// replaced hands its permissions on, and its owner and group where the system allows that; its other names
/// (hard links) keep the old content. One that may not be written to is not replaced either. One object
/// belongs to one thread at a time. For POSIX systems.
class OutputFile {
 public:
  /// Creates the temporary file, so that a path that cannot be written to is found out before any work is
  /// done.
  /// @throws FileError if that fails, if something other than a file has the name (a folder, a device, a
  /// pipe,
  ///   a socket), and if standard output or standard error goes to that file: what is printed would be lost.
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& path() const { return path_; }  ///< as it was given
  /// Where the content is until commit().
  const std::string& temporary_path() const { return temporary_; }
  /// What to open for those who open files themselves (HDF5), in this process or a child of it: it leads to
  /// the temporary file and to no new one, even if a signal has had that removed. They must have closed it
  /// before commit().
  std::string descriptor_path() const;

  /// Appends bytes, not buffered. @throws FileError, the disk being full, say.
  void write(std::string_view bytes);

  /// Brings the content to the disk, gives the file its name in one step and brings the folder to the disk.
  /// If only the last of these fails, the new file has the name nevertheless. To be called once.
  /// @throws FileError.
  void commit();

 private:
  void create(bool replaces_file);
  void hand_on_attributes();
  void close();
  void sync_folder() const;
  [[noreturn]] void fail_here(const std::string& what) const;
  [[noreturn]] void fail_here(const std::string& what, int reason) const;

  std::string path_;
  std::string final_path_;  ///< that of the file which path_ leads to
  std::string temporary_;   ///< empty once the file has its name
  int descriptor_ = -1;
  int place_ = -1;  ///< among the unfinished files
};

/// Removes the temporary files of all OutputFile objects of the process. Async-signal-safe: meant for the
/// handler of a signal that ends the process at once, so that no destructor runs. No object can be committed
/// afterwards.
void remove_unfinished_files() noexcept;

}  // namespace dch::trajectory
