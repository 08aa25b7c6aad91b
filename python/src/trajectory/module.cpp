// SPDX-License-Identifier: MIT
// The compiled half of dch.trajectory: frames of files as numpy arrays.
#include <algorithm>
#include <atomic>
#include <memory>
#include <pybind11/stl.h>

#include <dch/trajectory/file_error.hpp>
#include <dch/trajectory/reader.hpp>

#include "rows.hpp"
#include "threads.hpp"

namespace dch::python {
namespace {

using trajectory::Frame;
using trajectory::TrajectoryReader;

py::array cell_of(const Box& box) {
  std::vector<double> cell;
  for (int axis = 0; axis < 3; ++axis)
    for (int component = 0; component < 3; ++component)
      cell.push_back(box.kind() == Box::Kind::none ? 0 : box.vector(axis)[component]);
  return array_of(std::move(cell), {3, 3});
}

py::object numbers_or_none(std::vector<std::int32_t> numbers) {
  if (numbers.empty()) return py::none();
  return array_of(std::move(numbers));
}

py::tuple tuple_of(Frame frame) {
  const Box& box = frame.box;
  py::object time = py::none(), images = py::none();
  if (frame.time) time = py::float_(*frame.time);
  if (!frame.images.empty())
    images = rows_of<std::int32_t, 3>(frame.images, [](const auto& image) { return image; });
  py::array positions = rows_of<double, 3>(frame.positions, [](Vec3 p) {
    return std::array<double, 3>{p.x, p.y, p.z};
  });
  py::array ids = array_of(std::move(frame.ids));
  return py::make_tuple(frame.step, std::move(time), std::move(positions), cell_of(box),
                        py::make_tuple(box.periodic(0), box.periodic(1), box.periodic(2)), std::move(ids),
                        numbers_or_none(std::move(frame.types)), numbers_or_none(std::move(frame.molecules)),
                        std::move(images));
}

/// A file that is read from its beginning to its end.
class Reader {
 public:
  Reader(const std::string& path, const std::string& format) : reader_(open(path, format)) {}

  /// None at the end.
  py::object read() {
    const InUse in_use(used_, "Trajectory");
    Frame frame;
    {
      const py::gil_scoped_release release;
      if (!reader_ || !reader_->read(frame)) reader_.reset();
    }
    if (!reader_) return py::none();
    return tuple_of(std::move(frame));
  }
  void close() {
    const InUse in_use(used_, "Trajectory");
    reader_.reset();
  }
  std::string format() const { return format_; }
  std::string length_unit() const { return length_unit_; }

 private:
  std::unique_ptr<TrajectoryReader> open(const std::string& path, const std::string& format) {
    auto reader = trajectory::open_trajectory(path, format);
    format_ = reader->format();
    length_unit_ = reader->length_unit();
    return reader;
  }

  std::string format_, length_unit_;
  std::unique_ptr<TrajectoryReader> reader_;
  std::atomic<bool> used_{false};
};

}  // namespace
}  // namespace dch::python

PYBIND11_MODULE(_trajectory, m) {
  namespace py = pybind11;
  using dch::python::Reader;
  auto& error = py::register_exception<dch::trajectory::FileError>(
      m, "FileError", py::reinterpret_borrow<py::object>(PyExc_ValueError));
  error.attr("__doc__") =
      "A file that cannot be read, or is broken; the message names file, frame, and line or offset.";
  error.attr("__module__") = "dch.trajectory";
  m.def("formats", &dch::trajectory::trajectory_formats);
  py::class_<Reader>(m, "Reader")
      .def(py::init<const std::string&, const std::string&>(), py::arg("path"), py::arg("format"))
      .def("read", &Reader::read)
      .def("close", &Reader::close)
      .def("format", &Reader::format)
      .def("length_unit", &Reader::length_unit);
}
