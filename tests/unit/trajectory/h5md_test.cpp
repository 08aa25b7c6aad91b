// SPDX-License-Identifier: MIT
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <limits>

#include <dch/trajectory/writer.hpp>

#include "h5md/hdf5_attributes.hpp"
#include "h5md/hdf5_handle.hpp"
#include "reading.hpp"
#include "sample_frames.hpp"
#include "scratch_folder.hpp"

namespace dch::trajectory::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

/// Builds HDF5 files that H5mdWriter does not write.
class RawFile {
 public:
  explicit RawFile(const std::string& path)
      : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)) {}

  Hdf5Handle group(const std::string& name) {
    const Hdf5Handle parents(H5Pcreate(H5P_LINK_CREATE));
    H5Pset_create_intermediate_group(parents.get(), 1);
    return Hdf5Handle(H5Gcreate2(file_.get(), name.c_str(), parents.get(), H5P_DEFAULT, H5P_DEFAULT));
  }
  Hdf5Handle dataset(const std::string& name, const std::vector<hsize_t>& shape,
                     const std::vector<double>& values) {
    const Hdf5Handle parents(H5Pcreate(H5P_LINK_CREATE));
    H5Pset_create_intermediate_group(parents.get(), 1);
    const Hdf5Handle space(shape.empty()
                               ? H5Screate(H5S_SCALAR)
                               : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr));
    Hdf5Handle dataset(H5Dcreate2(file_.get(), name.c_str(), H5T_NATIVE_DOUBLE, space.get(), parents.get(),
                                  H5P_DEFAULT, H5P_DEFAULT));
    H5Dwrite(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    return dataset;
  }
  void remove(const std::string& name) { H5Ldelete(file_.get(), name.c_str(), H5P_DEFAULT); }
  hid_t get() const { return file_.get(); }

 private:
  Hdf5Handle file_;
};

class H5md : public testing::Test {
 protected:
  std::vector<Frame> write_and_read(const std::vector<Frame>& frames, const std::string& unit = "nm") {
    const auto writer = create_trajectory(path_, unit);
    for (const Frame& frame : frames) writer->write(frame);
    writer->close();
    return read_all(path_);
  }
  /// What reading says about a file of two atoms and two frames that `change` has changed.
  std::string error(const std::function<void(RawFile&)>& change) {
    {
      RawFile file(path_);
      file.dataset("particles/p/position/value", {2, 2, 3}, {0, 0, 0, 1, 1, 1, 0, 0, 0, 2, 2, 2});
      file.dataset("particles/p/position/step", {2}, {0, 10});
      write_attribute(file.group("particles/p/box").get(), "boundary",
                      std::vector<std::string>(3, "periodic"));
      file.dataset("particles/p/box/edges", {3}, {4, 4, 4});
      change(file);
    }
    return try_to_read(path_).error;
  }

  ScratchFolder folder_;
  std::string path_ = folder_.path("test.h5");
};

TEST_F(H5md, WritesWhatTheReaderReads) {
  for (const Box& box :
       {Box::none(), Box::orthorhombic({10, 20, 30}),
        Box::orthorhombic({10, 20, 30}, {true, false, false}, {-5, 0.5, 1.25}),
        Box::triclinic({1, 10, 0}, {-10, 1, 0.5}, {0, 2, 30}, {true, true, false}, {1, 2, 3})}) {
    const std::vector<Frame> frames{sample_frame(0, box), sample_frame(1, box), sample_frame(2, box)};
    const auto back = write_and_read(frames);
    ASSERT_EQ(back.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) expect_equal(back[k], frames[k]);
  }
}

TEST_F(H5md, KeepsBoxesThatChangeAndFramesWithoutBoxOrTime) {
  std::vector<Frame> frames{
      sample_frame(0, Box::none()), sample_frame(1, Box::orthorhombic({10, 20, 30})),
      sample_frame(2, Box::triclinic({10, 0, 0}, {1, 20, 0}, {0, 0, 30}, {true, true, true}, {0, 1, 0})),
      sample_frame(3, Box::none())};
  frames[2].time.reset();
  const auto back = write_and_read(frames);
  ASSERT_EQ(back.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) expect_equal(back[k], frames[k]);
}

TEST_F(H5md, RecordsTheUnit) {
  for (const char* unit : {"nm", "Angstrom", "sigma", "the dump's unit"}) {
    write_and_read({sample_frame(0, Box::none())}, unit);
    EXPECT_EQ(open_trajectory(path_)->length_unit(), unit);
  }
}

TEST_F(H5md, RefusesFramesTheFormatHasNoPlaceFor) {
  const auto refuses = [&](const auto& change, const char* reason) {
    const auto writer = create_trajectory(path_, "nm");
    Frame frame = sample_frame(0, Box::orthorhombic({4, 4, 4}));
    writer->write(frame);
    change(frame);
    EXPECT_THAT([&] { writer->write(frame); },
                ThrowsMessage<FileError>(AllOf(HasSubstr("frame 1 cannot be written"), HasSubstr(reason))));
  };
  refuses([](Frame& f) { f.ids[0] = 1; }, "other atoms");
  refuses([](Frame& f) { f.types[0] = 9; }, "types");
  refuses([](Frame& f) { f.molecules.clear(); }, "molecule numbers");
  refuses([](Frame& f) { f.images.clear(); }, "image flags");
  refuses(
      [](Frame& f) {
        f.box = Box::orthorhombic({4, 4, 4}, {true, true, false});
      },
      "periodic along other axes");
  const auto writer = create_trajectory(path_, "nm");
  EXPECT_THAT([&] { writer->write(Frame()); }, ThrowsMessage<FileError>(HasSubstr("without atoms")));
  const auto empty = create_trajectory(path_, "nm");
  EXPECT_THAT([&] { empty->close(); }, ThrowsMessage<FileError>(HasSubstr("no frame")));
}

TEST_F(H5md, ReadsWhatOtherProgramsWrite) {
  const std::string error_text = error([](RawFile& file) {
    // Increments instead of one number a frame, float and fixed boxes, atoms out of order.
    file.remove("particles/p/position/step");
    const Hdf5Handle step = file.dataset("particles/p/position/step", {}, {50});
    const double offset = 1000;
    const Hdf5Handle scalar(H5Screate(H5S_SCALAR));
    const Hdf5Handle attribute(
        H5Acreate2(step.get(), "offset", H5T_NATIVE_DOUBLE, scalar.get(), H5P_DEFAULT, H5P_DEFAULT));
    H5Awrite(attribute.get(), H5T_NATIVE_DOUBLE, &offset);
    const Hdf5Handle time = file.dataset("particles/p/position/time", {2}, {100, 200});
    write_attribute(time.get(), "unit", std::string("fs"));
    file.dataset("particles/p/id/value", {2, 2}, {7, 5, 5, 7});
    file.dataset("particles/p/species", {2}, {1, 2});
  });
  ASSERT_EQ(error_text, "");
  const auto frames = read_all(path_);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[1].step, 1050);
  EXPECT_DOUBLE_EQ(frames[1].time.value(), 0.2);
  EXPECT_EQ(frames[0].box, Box::orthorhombic({4, 4, 4}));
  EXPECT_THAT(frames[0].ids, ElementsAre(5, 7));
  EXPECT_THAT(frames[0].positions, ElementsAre(Vec3{1, 1, 1}, Vec3{0, 0, 0}));
  EXPECT_THAT(frames[0].types, ElementsAre(2, 1));
  EXPECT_THAT(frames[1].positions, ElementsAre(Vec3{0, 0, 0}, Vec3{2, 2, 2}));
  EXPECT_THAT(frames[1].types, ElementsAre(1, 2));
  EXPECT_EQ(open_trajectory(path_)->length_unit(), "the file's unit");
}

TEST_F(H5md, ReadsASingleFixedFrame) {
  {
    RawFile file(path_);
    file.dataset("particles/p/position", {1, 3}, {1, 2, 3});
  }
  const auto frames = read_all(path_);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_THAT(frames[0].positions, ElementsAre(Vec3{1, 2, 3}));
  EXPECT_THAT(frames[0].ids, ElementsAre(1));
  EXPECT_EQ(frames[0].box, Box::none());
}

TEST_F(H5md, ChoosesTheGroupOfParticles) {
  const std::vector<double> values(6, 1.0);
  EXPECT_EQ(error([&](RawFile& file) {
              file.dataset("particles/trajectory/position/value", {1, 2, 3}, values);
            }),
            "");
  EXPECT_EQ(read_all(path_).size(), 1u);
  EXPECT_THAT(error([&](RawFile& file) {
                file.dataset("particles/q/position/value", {1, 2, 3}, values);
              }),
              HasSubstr("2 groups with positions (p, q, ...), none called 'trajectory' or 'all'"));
  EXPECT_EQ(error([&](RawFile& file) { file.group("particles/q"); }), "");
}

TEST_F(H5md, RefusesWhatIsNotH5md) {
  folder_.write("test.h5", "This is no HDF5 file.");
  EXPECT_THAT(try_to_read(path_).error, AllOf(HasSubstr(path_), HasSubstr("not a readable HDF5 file")));
  { RawFile file(path_); }
  EXPECT_THAT(try_to_read(path_).error, HasSubstr("no group 'particles'"));
  RawFile(path_).group("particles/p");
  EXPECT_THAT(try_to_read(path_).error, HasSubstr("no group in 'particles' has positions"));
}

TEST_F(H5md, RefusesBadElements) {
  const std::string p = "particles/p/";
  const auto replaced = [&](const std::string& name, const std::vector<hsize_t>& shape,
                            const std::vector<double>& values) {
    return error([&](RawFile& file) {
      file.remove(p + name.substr(0, name.find('/', name.find("box/") == 0 ? 4 : 0)));
      file.dataset(p + name, shape, values);
    });
  };
  const std::vector<double> numbers(100, 1.0);
  EXPECT_THAT(replaced("position/value", {2, 2, 2}, numbers),
              HasSubstr("/particles/p/position: does not have three"));
  EXPECT_THAT(replaced("position/value", {0, 2, 3}, {}), HasSubstr("holds no frame"));
  EXPECT_THAT(replaced("position/other", {2, 2, 3}, numbers), HasSubstr("no dataset 'value'"));
  EXPECT_THAT(replaced("box/edges", {2}, numbers),
              HasSubstr("/particles/p/box/edges: has not three numbers"));
  EXPECT_THAT(replaced("box/edges/value", {3, 3}, numbers), HasSubstr("has 3 frames, position has 2"));
  EXPECT_THAT(replaced("box/edges", {3}, {4, 0, 4}), AllOf(HasSubstr("frame 0"), HasSubstr("box/edges")));
  EXPECT_THAT(replaced("box/edges", {3}, {4, -4, 4}), HasSubstr("frame 0"));
  EXPECT_THAT(replaced("position/step", {1}, {0}), HasSubstr("no dataset 'value'"));
  EXPECT_THAT(error([&](RawFile& file) { file.remove(p + "box/edges"); }),
              HasSubstr("is periodic but has no 'edges'"));
  EXPECT_THAT(error([&](RawFile& file) {
                file.remove(p + "box");
                write_attribute(file.group(p + "box").get(), "boundary", std::vector<std::string>(3, "open"));
              }),
              HasSubstr("attribute 'boundary'"));
  EXPECT_THAT(error([&](RawFile& file) {
                file.remove(p + "position/step");
                file.dataset(p + "position/step", {1}, {0});
              }),
              HasSubstr("its 'step' ends before frame 1"));
  EXPECT_THAT(error([&](RawFile& file) {
                file.dataset(p + "id", {3}, {1, 2, 3});
              }),
              HasSubstr("each of the 2 atoms"));
  EXPECT_THAT(error([&](RawFile& file) {
                file.dataset(p + "id/value", {1, 2}, {1, 2});
              }),
              HasSubstr("has 1 frames"));
  EXPECT_THAT(error([&](RawFile& file) {
                file.dataset(p + "id", {2}, {8, 8});
              }),
              AllOf(HasSubstr("frame 0"), HasSubstr("the id 8 appears twice")));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error([&](RawFile& file) {
                file.remove(p + "position/value");
                file.dataset(p + "position/value", {2, 2, 3}, {0, 0, 0, 1, 1, 1, 0, 0, 0, 2, nan, 2});
              }),
              AllOf(HasSubstr("frame 1, /particles/p/position"), HasSubstr("not finite")));
}

TEST_F(H5md, RefusesMoreAtomsThanTheFileCanHold) {
  EXPECT_THAT(error([](RawFile& file) {
                file.remove("particles/p/position");
                // A chunked dataset that nothing has been written to takes no space.
                const hsize_t shape[] = {1, 2000000000, 3}, chunk[] = {1, 1024, 3};
                const Hdf5Handle space(H5Screate_simple(3, shape, nullptr));
                const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE));
                H5Pset_chunk(properties.get(), 3, chunk);
                const Hdf5Handle group = file.group("particles/p/position");
                const Hdf5Handle value(H5Dcreate2(group.get(), "value", H5T_NATIVE_FLOAT, space.get(),
                                                  H5P_DEFAULT, properties.get(), H5P_DEFAULT));
              }),
              HasSubstr("claims 2000000000 atoms"));
}

}  // namespace
}  // namespace dch::trajectory::test
