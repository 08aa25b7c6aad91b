// SPDX-License-Identifier: MIT
#include "report/hdf5_file.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <exception>
#include <new>
#include <sys/socket.h>
#include <system_error>

#include <dch/trajectory/file_error.hpp>

#include "process/byte_channel.hpp"
#include "process/child_process.hpp"
#include "process/frame_channel.hpp"
#include "report/hdf5_output.hpp"

namespace dch::cli {
namespace {

using trajectory::FrameReceiver;
using trajectory::FrameSender;
using trajectory::Message;

enum class Task : int { group, text, real, whole, dataset, append, finish };

}  // namespace

/// What the child is asked to do; the data follow.
struct Hdf5File::Request {
  Task task;
  Hdf5Type type = Hdf5Type::int64;
  std::int64_t columns = 0;
  std::int64_t rows = 0;  ///< of the data, or of a chunk
  std::uint64_t data_bytes = 0;
  std::array<char, 32> name{};  ///< ends in a zero
};

Hdf5File::Hdf5File(const std::string& path) : file_(path) {
  try {
    child_ = std::make_unique<trajectory::ChildProcess>(
        [this](int socket) { answer_all(socket, file_.descriptor_path()); });
  } catch (const std::system_error& error) {
    fail(std::string("no process to write it in: ") + error.what());
  }
}

Hdf5File::~Hdf5File() = default;

void Hdf5File::create_group(const std::string& name) { send({Task::group}, name, nullptr); }

void Hdf5File::write_attribute(const std::string& name, const std::string& value) {
  Request request{Task::text};
  request.data_bytes = value.size();
  send(request, name, value.data());
}

void Hdf5File::write_attribute(const std::string& name, double value) {
  Request request{Task::real};
  request.data_bytes = sizeof value;
  send(request, name, &value);
}

void Hdf5File::write_attribute(const std::string& name, std::int64_t value) {
  Request request{Task::whole};
  request.data_bytes = sizeof value;
  send(request, name, &value);
}

void Hdf5File::create_dataset(const std::string& name, Hdf5Type type, std::int64_t columns,
                              std::int64_t chunk_rows) {
  send({Task::dataset, type, columns, chunk_rows}, name, nullptr);
}

void Hdf5File::append(const std::string& name, std::int64_t columns,
                      const std::vector<std::int64_t>& values) {
  append_values(name, columns, Hdf5Type::int64, values);
}

void Hdf5File::append(const std::string& name, std::int64_t columns,
                      const std::vector<std::int32_t>& values) {
  append_values(name, columns, Hdf5Type::int32, values);
}

void Hdf5File::append(const std::string& name, std::int64_t columns, const std::vector<double>& values) {
  append_values(name, columns, Hdf5Type::float64, values);
}

template <class Value>
void Hdf5File::append_values(const std::string& name, std::int64_t columns, Hdf5Type type,
                             const std::vector<Value>& values) {
  constexpr std::int64_t kEntriesAtOnce = 8 * kChunkEntries;  // the child need not hold a whole list
  const std::int64_t width = std::max<std::int64_t>(1, columns);
  const std::int64_t rows = static_cast<std::int64_t>(values.size()) / width;
  const std::int64_t most = std::max<std::int64_t>(1, kEntriesAtOnce / width);
  for (std::int64_t first = 0; first < rows; first += most) {
    Request request{Task::append, type, columns, std::min(most, rows - first)};
    request.data_bytes = static_cast<std::uint64_t>(request.rows * width) * sizeof(Value);
    send(request, name, values.data() + first * width);
  }
}

void Hdf5File::commit() {
  send({Task::finish}, "", nullptr);
  child_.reset();
  file_.commit();
}

/// Waits for the answer, so that an error is told where it belongs. A child that was sent no whole request
/// would wait for the rest, as this process for its answer: without a connection it ends.
void Hdf5File::send(Request request, const std::string& name, const void* data) {
  assert(name.size() < request.name.size());
  name.copy(request.name.data(), request.name.size() - 1);
  const int socket = child_->socket();
  const bool was_sent = trajectory::send_bytes(socket, &request, sizeof request) &&
                        trajectory::send_bytes(socket, data, request.data_bytes);
  if (!was_sent) ::shutdown(socket, SHUT_WR);
  FrameReceiver receiver(socket);
  Message kind{};
  std::string what;
  if (!receiver.receive_kind(kind) || (kind == Message::error && !receiver.receive_text(what))) {
    fail("HDF5 failed: " + child_->wait_and_describe());
  }
  if (kind == Message::error) fail(what);
}

void Hdf5File::fail(const std::string& what) const {
  throw trajectory::FileError(file_.path() + ": cannot be written: " + what);
}

/// In the child: false when there is nothing more to do.
bool Hdf5File::answer_one(int socket, Hdf5Output& output) {
  Request request{};
  if (!trajectory::receive_bytes(socket, &request, sizeof request)) return false;
  std::vector<char> data(request.data_bytes);
  if (!trajectory::receive_bytes(socket, data.data(), data.size())) return false;
  const std::string name(request.name.data());
  const auto number = [&](auto value) {
    std::memcpy(&value, data.data(), sizeof value);
    return value;
  };
  switch (request.task) {
    case Task::group:
      output.create_group(name);
      break;
    case Task::text:
      output.write_attribute(name, std::string(data.begin(), data.end()));
      break;
    case Task::real:
      output.write_attribute(name, number(double{}));
      break;
    case Task::whole:
      output.write_attribute(name, number(std::int64_t{}));
      break;
    case Task::dataset:
      output.create_dataset(name, request.type, request.columns, request.rows);
      break;
    case Task::append:
      output.append(name, request.type, request.rows, request.columns, data.data());
      break;
    case Task::finish:
      output.close();
      break;
  }
  return FrameSender(socket).send_done() && request.task != Task::finish;
}

void Hdf5File::answer_all(int socket, const std::string& path) try {
  Hdf5Output output(path);
  while (answer_one(socket, output)) {
  }
} catch (const std::bad_alloc&) {
  FrameSender(socket).send_error("not enough memory");
} catch (const std::exception& error) {
  FrameSender(socket).send_error(error.what());
}

}  // namespace dch::cli
