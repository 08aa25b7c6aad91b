// SPDX-License-Identifier: MIT
// H5MD files that lead out of themselves: nothing of another file is read, and nothing hangs.
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/stat.h>

#include "h5md/hdf5_handle.hpp"
#include "reading.hpp"
#include "scratch_folder.hpp"

namespace dch::trajectory::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class H5mdOutside : public testing::Test {
 protected:
  void SetUp() override {
    secret_ = folder_.write("secret", std::string(4096, 'S'));
    write(other_, [&](hid_t file) { write_positions(file, H5P_DEFAULT); });
  }

  void write(const std::string& path, const std::function<void(hid_t)>& content) {
    const Hdf5Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    content(file.get());
  }

  Hdf5Handle group(hid_t file, const char* name) {
    const Hdf5Handle parents(H5Pcreate(H5P_LINK_CREATE));
    H5Pset_create_intermediate_group(parents.get(), 1);
    return Hdf5Handle(H5Gcreate2(file, name, parents.get(), H5P_DEFAULT, H5P_DEFAULT));
  }

  /// Positions of two frames of two atoms; `layout` says where the numbers are.
  void write_positions(hid_t file, hid_t layout) {
    const Hdf5Handle position = group(file, "particles/p/position");
    const hsize_t shape[] = {2, 2, 3};
    const Hdf5Handle space(H5Screate_simple(3, shape, nullptr));
    const Hdf5Handle value(H5Dcreate2(position.get(), "value", H5T_NATIVE_DOUBLE, space.get(), H5P_DEFAULT,
                                      layout, H5P_DEFAULT));
    const double numbers[12] = {};
    if (layout == H5P_DEFAULT) {
      H5Dwrite(value.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers);
    }
  }

  std::string error(const std::function<void(hid_t)>& content) {
    write(path_, content);
    const Outcome outcome = try_to_read(path_);
    EXPECT_EQ(outcome.frames, 0u);
    EXPECT_THAT(outcome.error, AllOf(HasSubstr("test.h5"), Not(HasSubstr("signal"))));
    return outcome.error;
  }

  ScratchFolder folder_;
  std::string path_ = folder_.path("test.h5"), other_ = folder_.path("other.h5");
  std::string secret_;
};

TEST_F(H5mdOutside, TheOtherFileIsGood) { EXPECT_EQ(try_to_read(other_).frames, 2u); }

/// The only child of this process, or 0.
int child() {
  int id = 0;
  std::ifstream("/proc/thread-self/children") >> id;
  return id;
}

TEST_F(H5mdOutside, TheChildHasGivenUpItsRights) {
  const auto reader = open_trajectory(other_);
  const int id = child();
  ASSERT_GT(id, 0);
  const std::string status = read_file("/proc/" + std::to_string(id) + "/status");
  EXPECT_THAT(status, AllOf(HasSubstr("Seccomp:\t2"), HasSubstr("NoNewPrivs:\t1")));
  const std::string limits = read_file("/proc/" + std::to_string(id) + "/limits");
#if !defined(__SANITIZE_ADDRESS__)  // whose builds leave the sanitizers their pipes, see child_rights.cpp
  EXPECT_THAT(limits, testing::ContainsRegex("Max open files +0 +0 "));
#endif
  EXPECT_THAT(limits, testing::Not(testing::ContainsRegex("Max address space +unlimited")));
  Frame frame;
  EXPECT_TRUE(reader->read(frame));
}

TEST_F(H5mdOutside, ExternalStorage) {
  const Hdf5Handle layout(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_external(layout.get(), secret_.c_str(), 0, H5F_UNLIMITED);
  EXPECT_THAT(error([&](hid_t file) { write_positions(file, layout.get()); }), HasSubstr("external storage"));
}

TEST_F(H5mdOutside, VirtualDataset) {
  const Hdf5Handle layout(H5Pcreate(H5P_DATASET_CREATE));
  const hsize_t shape[] = {2, 2, 3};
  const Hdf5Handle space(H5Screate_simple(3, shape, nullptr));
  H5Pset_virtual(layout.get(), space.get(), other_.c_str(), "/particles/p/position/value", space.get());
  EXPECT_THAT(error([&](hid_t file) { write_positions(file, layout.get()); }), HasSubstr("virtual dataset"));
}

TEST_F(H5mdOutside, ExternalLinks) {
  const auto link_to = [&](const std::string& target, const char* object, hid_t group, const char* name) {
    H5Lcreate_external(target.c_str(), object, group, name, H5P_DEFAULT, H5P_DEFAULT);
  };
  ASSERT_EQ(::mkfifo(folder_.path("pipe").c_str(), 0600), 0);
  for (const std::string& target : {other_, folder_.path("pipe"), secret_, folder_.path("missing")}) {
    EXPECT_THAT(error([&](hid_t file) { link_to(target, "/particles", file, "particles"); }),
                HasSubstr("'particles' is a link to another file"));
    EXPECT_THAT(error([&](hid_t file) {
                  link_to(target, "/particles/p/position", group(file, "particles/p").get(), "position");
                }),
                HasSubstr("'particles/p/position' leads to another file"));
    EXPECT_THAT(
        error([&](hid_t file) { link_to(target, "/particles/p", group(file, "particles").get(), "p"); }),
        HasSubstr("leads to another file"));
    EXPECT_THAT(error([&](hid_t file) {
                  link_to(target, "/particles/p/position/value", group(file, "particles/p/position").get(),
                          "value");
                }),
                HasSubstr("'value' is a link to another file"));
    // Behind a link within the file only the rights that the child has given up are in the way.
    error([&](hid_t file) {
      link_to(target, "/particles/p/position", file, "outside");
      H5Lcreate_soft("/outside", group(file, "particles/p").get(), "position", H5P_DEFAULT, H5P_DEFAULT);
    });
  }
}

}  // namespace
}  // namespace dch::trajectory::test
