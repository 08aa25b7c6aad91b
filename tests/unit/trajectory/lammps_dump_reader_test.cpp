// SPDX-License-Identifier: MIT
//
// More than 300 lines: the format's cases, good and bad, side by side.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ostream>
#include <string>
#include <zlib.h>

#include "reading.hpp"
#include "scratch_folder.hpp"

namespace dch::trajectory::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A dump of one frame whose parts can be replaced.
struct Dump {
  std::string step = "7";
  std::string count = "2";
  std::string labels = " pp pp pp";
  std::string box = "0 20\n0 30\n0 40\n";
  std::string columns = " id type x y z";
  std::string atoms = "1 1 5 5 5\n2 5 6.5 6.5 6.5\n";

  std::string text() const {
    return "ITEM: TIMESTEP\n" + step + "\nITEM: NUMBER OF ATOMS\n" + count + "\nITEM: BOX BOUNDS" + labels +
           "\n" + box + "ITEM: ATOMS" + columns + "\n" + atoms;
  }
};

class LammpsDumpReader : public testing::Test {
 protected:
  std::vector<Frame> read(const std::string& text) { return read_all(folder_.write("test.dump", text)); }
  Frame read_one(const Dump& dump) { return read(dump.text()).at(0); }
  std::string error(const std::string& text) { return try_to_read(folder_.write("test.dump", text)).error; }
  std::string error(const Dump& dump) { return error(dump.text()); }

  ScratchFolder folder_;
};

TEST_F(LammpsDumpReader, ReadsThePolymer) {
  const auto frames = read_all(data_path("polymer.lammpstrj"));
  ASSERT_EQ(frames.size(), 42u);
  const Frame& first = frames.front();
  EXPECT_EQ(first.step, 0);
  EXPECT_FALSE(first.time);
  EXPECT_EQ(frames.back().step, 20500);
  ASSERT_EQ(first.positions.size(), 1714u);
  EXPECT_EQ(first.box, Box::orthorhombic({109.047 - 50.9533, 134.047 - 75.9533, 134.047 - 75.9533},
                                         {true, true, true}, {50.9533, 75.9533, 75.9533}));
  // The first row of the file.
  EXPECT_EQ(first.ids[972], 973);
  EXPECT_EQ(first.positions[972], (Vec3{56.0485, 82.333, 81.1896}));
  EXPECT_EQ(first.molecules[972], 36);
  EXPECT_EQ(first.types[972], 2);
  EXPECT_THAT(first.images[972], ElementsAre(2, 1, 2));
  for (const Frame& frame : frames) EXPECT_EQ(frame.ids, first.ids);
}

TEST_F(LammpsDumpReader, LetsAtomsWithIdsComeAndGo) {
  const auto frames = read_all(data_path("detect_best_pos_repr.lammpstrj"));
  ASSERT_EQ(frames.size(), 5u);
  EXPECT_EQ(frames[1].positions.size(), 854u);
  EXPECT_EQ(frames[2].positions.size(), 856u);
  EXPECT_EQ(frames[0].time, 25000000000.0);
  EXPECT_FALSE(frames[1].time);
}

TEST_F(LammpsDumpReader, TakesTheFirstCompleteSetOfCoordinates) {
  // The columns differ from frame to frame (x, xu, xs, x, xsu); an atom keeps its place but for rounding to
  // six digits.
  const auto frames = read_all(data_path("detect_best_pos_repr.lammpstrj"));
  ASSERT_EQ(frames[0].ids[527], 528);
  const Vec3 expected[] = {
      {54, 8.4, 0}, {54, 8.4, 0}, {10 + 60 * 0.733333, -10.5 + 60 * 0.315, 0}, {54, 8.4, 0}, {54, 8.4, 0}};
  for (std::size_t k = 0; k < 5; ++k) {
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(frames[k].positions[527][axis], expected[k][axis], 3e-5) << k;
  }
  EXPECT_FALSE(frames[0].images.empty());
  EXPECT_FALSE(frames[0].box.periodic(2));
}

TEST_F(LammpsDumpReader, UnscalesAndKeepsTheOrderOfTheFileWithoutIds) {
  const auto frames = read_all(data_path("nacl.lammpstrj"));
  ASSERT_EQ(frames.size(), 6u);
  EXPECT_EQ(frames[0].ids[0], 1);
  EXPECT_EQ(frames[0].ids[511], 512);
  const double low = -1.41005, length = 21.150751 + 1.41005;
  EXPECT_NEAR(frames[0].positions[1].z, low + 0.1875 * length, 1e-12);
  EXPECT_THAT(frames[0].types, IsEmpty());
  EXPECT_THAT(frames[0].molecules, IsEmpty());
  EXPECT_THAT(frames[0].images, IsEmpty());
}

TEST_F(LammpsDumpReader, SortsByIdWhateverTheOrderOfColumnsAndRows) {
  Dump dump;
  dump.columns = " z mol vx x type iy iz ix y id";
  dump.atoms = "3 9 0.5 1 4 6 7 5 2 20\n30 90 0.5 10 40 60 70 50 20 -3\n";
  const Frame frame = read_one(dump);
  EXPECT_THAT(frame.ids, ElementsAre(-3, 20));
  EXPECT_THAT(frame.positions, ElementsAre(Vec3{10, 20, 30}, Vec3{1, 2, 3}));
  EXPECT_THAT(frame.types, ElementsAre(40, 4));
  EXPECT_THAT(frame.molecules, ElementsAre(90, 9));
  EXPECT_THAT(frame.images, ElementsAre(ElementsAre(50, 60, 70), ElementsAre(5, 6, 7)));
}

TEST_F(LammpsDumpReader, DropsImageFlagsOfUnwrappedCoordinates) {
  Dump dump;
  dump.columns = " id xu yu zu ix iy iz";
  dump.atoms = "1 25 5 5 1 0 0\n2 6 6 6 0 0 0\n";
  EXPECT_THAT(read_one(dump).images, IsEmpty());
}

TEST_F(LammpsDumpReader, ReadsTriclinicBounds) {
  Dump dump;
  // lx = 20, ly = 30, lz = 40 from (1, 2, 3) with the tilts xy = -5, xz = 8, yz = -6, so that the bounds of x
  // reach from 1 - 5 to 21 + 8 and those of y from 2 - 6 to 32.
  dump.labels = " xy xz yz pp ff sm";
  dump.box = "-4 29 -5\n-4 32 8\n3 43 -6\n";
  dump.columns = " id xs ys zs";
  dump.atoms = "1 0 0 0\n2 0.5 0.5 0.5\n";
  const Frame frame = read_one(dump);
  EXPECT_EQ(frame.box, Box::triclinic({20, 0, 0}, {-5, 30, 0}, {8, -6, 40}, {true, false, false}, {1, 2, 3}));
  EXPECT_EQ(frame.positions[0], (Vec3{1, 2, 3}));
  EXPECT_EQ(frame.positions[1], (Vec3{1 + 10 - 2.5 + 4, 2 + 15 - 3, 3 + 20}));
}

TEST_F(LammpsDumpReader, ReadsGeneralTriclinicVectors) {
  Dump dump;
  dump.labels = " abc origin pp pp ff";
  dump.box = "0 10 0 1\n-10 0 1 2\n0 2 9 3\n";
  EXPECT_EQ(read_one(dump).box,
            Box::triclinic({0, 10, 0}, {-10, 0, 1}, {0, 2, 9}, {true, true, false}, {1, 2, 3}));
}

TEST_F(LammpsDumpReader, ReadsBoundaries) {
  Dump dump;
  dump.labels = " fs mf pp";
  EXPECT_EQ(read_one(dump).box.description(),
            Box::orthorhombic({20, 30, 40}, {false, false, true}).description());
  dump.labels = "";  // LAMMPS before 2010 wrote none; its boxes were periodic
  EXPECT_EQ(read_one(dump).box, Box::orthorhombic({20, 30, 40}));
  dump.box = "0 0\n0 0\n0.0 0.0\n";
  EXPECT_EQ(read_one(dump).box, Box::none());
  dump.labels = " xy xz yz pp pp pp";
  dump.box = "0 0 0\n0 0 0\n0 0 0\n";
  EXPECT_EQ(read_one(dump).box, Box::none());
  dump.box = "0 20 1e-17\n0 30 0\n0 40 -1e-17\n";
  EXPECT_EQ(read_one(dump).box.kind(), Box::Kind::orthorhombic);
}

TEST_F(LammpsDumpReader, ReadsUnitsAndTimes) {
  const std::string units = "ITEM: UNITS\nreal\nITEM: TIME\n1500\n";
  const std::string path = folder_.write("units.dump", units + Dump().text() + Dump().text());
  const auto reader = open_trajectory(path);
  EXPECT_EQ(reader->length_unit(), "Angstrom");
  const auto frames = read_all(*reader);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_DOUBLE_EQ(frames[0].time.value(), 1.5);  // fs to ps
  EXPECT_FALSE(frames[1].time);
  EXPECT_EQ(open_trajectory(folder_.write("none.dump", Dump().text()))->length_unit(), "the dump's unit");
  EXPECT_EQ(open_trajectory(folder_.write("lj.dump", "ITEM: UNITS\nlj\n" + Dump().text()))->length_unit(),
            "sigma");
}

TEST_F(LammpsDumpReader, AcceptsWindowsLineEndsBlankLinesAndNoAtoms) {
  std::string text = Dump().text();
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
    text.replace(at, 1, "\r\n");
  EXPECT_EQ(read(text + "\r\n" + text + "\r\n\r\n").size(), 2u);
  Dump empty;
  empty.count = "0";
  empty.atoms = "";
  EXPECT_EQ(read_one(empty).positions.size(), 0u);
}

TEST_F(LammpsDumpReader, ReadsGzipOfSeveralMembers) {
  const std::string path = folder_.path("test.lammpstrj.gz");
  for (const char* mode : {"wb", "ab"}) {
    const gzFile file = gzopen(path.c_str(), mode);
    ASSERT_NE(file, nullptr);
    const std::string text = Dump().text();
    EXPECT_EQ(gzwrite(file, text.data(), static_cast<unsigned>(text.size())), static_cast<int>(text.size()));
    gzclose(file);
  }
  EXPECT_EQ(read_all(path).size(), 2u);
  folder_.write("garbage.dump.gz", read_file(path) + "garbage");
  EXPECT_THAT(try_to_read(folder_.path("garbage.dump.gz")).error,
              AllOf(HasSubstr("frame 2"), HasSubstr("broken")));
  folder_.write("plain.dump.gz", Dump().text());
  EXPECT_EQ(read_all(folder_.path("plain.dump.gz")).size(), 1u);
}

struct BadFile {
  const char* name;
  std::size_t good_frames;
  const char* place;
  const char* reason;
};

std::ostream& operator<<(std::ostream& out, const BadFile& file) { return out << file.name; }

class BadDump : public testing::TestWithParam<BadFile> {};

TEST_P(BadDump, EndsInAnErrorThatNamesFileFrameAndLine) {
  const std::string path = data_path(std::string("bad/") + GetParam().name + ".lammpstrj");
  const Outcome outcome = try_to_read(path);
  EXPECT_EQ(outcome.frames, GetParam().good_frames);
  EXPECT_THAT(outcome.error, AllOf(HasSubstr(path + ": " + GetParam().place), HasSubstr(GetParam().reason)));
}

INSTANTIATE_TEST_SUITE_P(
    Chemfiles, BadDump,
    testing::Values(
        BadFile{"atom-duplicated-id", 0, "frame 0, line 11: ", "id 2 appears a second time"},
        BadFile{"atom-item-name", 0, "frame 0, line 9: ", "unknown item 'DUMMY'"},
        BadFile{"atom-no-item", 0, "frame 0, line 9: ", "expected 'ITEM: ...', found 'DUMMY'"},
        BadFile{"atom-not-enough-lines", 0, "frame 0, line 11: ", "after 2 of the frame's 3 atoms"},
        BadFile{"atom-too-many-fields", 0, "frame 0, line 10: ", "expected 5 fields"},
        BadFile{"box-item-name", 0, "frame 0, line 5: ", "unknown item 'DUMMY'"},
        BadFile{"box-not-item", 0, "frame 0, line 5: ", "expected 'ITEM: ...', found 'DUMMY'"},
        BadFile{"box-not-numbers", 0, "frame 0, line 6: ", "expected 2 numbers"},
        BadFile{"box-wrong-size", 0, "frame 0, line 6: ", "expected 3 numbers"},
        BadFile{"items-after-atoms", 1, "frame 1, line 15: ", "in front of 'ITEM: ATOMS'"},
        BadFile{"timestep-item-name", 0, "frame 0, line 1: ", "unknown item 'DUMMY'"},
        BadFile{"timestep-no-item", 0, "frame 0, line 1: ", "expected 'ITEM: ...', found 'DUMMY'"}),
    [](const auto& test) {
      std::string name = test.param.name;
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

TEST_F(LammpsDumpReader, RefusesEachFrameOfTheBadBoxes) {
  const std::string start = "ITEM: TIMESTEP";
  for (const char* name : {"bad/box-not-numbers.lammpstrj", "bad/box-wrong-size.lammpstrj"}) {
    const std::string text = read_file(data_path(name));
    int frames = 0;
    for (std::size_t at = 0; at != std::string::npos; ++frames) {
      const std::size_t next = text.find(start, at + 1);
      EXPECT_THAT(error(text.substr(at, next - at)), HasSubstr("numbers")) << name << " frame " << frames;
      at = next;
    }
    EXPECT_EQ(frames, 3);
  }
}

TEST_F(LammpsDumpReader, RefusesBadNumbers) {
  const auto with_atom = [](const std::string& atom) {
    Dump dump;
    dump.atoms = "1 1 5 5 5\n" + atom + "\n";
    return dump;
  };
  EXPECT_THAT(error(with_atom("2 1 nan 5 5")), AllOf(HasSubstr("frame 0, line 11"), HasSubstr("not finite")));
  EXPECT_THAT(error(with_atom("2 1 5 -inf 5")), HasSubstr("not finite"));
  EXPECT_THAT(error(with_atom("2 1 5 5 1e101")), HasSubstr("not finite or larger"));
  EXPECT_THAT(error(with_atom("2 1 5 5 1e400")), HasSubstr("expected the coordinate z, found '1e400'"));
  EXPECT_THAT(error(with_atom("2 1 5 5 5.0x")), HasSubstr("expected the coordinate z, found '5.0x'"));
  EXPECT_THAT(error(with_atom("2.5 1 5 5 5")), HasSubstr("expected an atom id, found '2.5'"));
  EXPECT_THAT(error(with_atom("2 C 5 5 5")), HasSubstr("expected an atom type, found 'C'"));
  EXPECT_THAT(error(with_atom("2 1 5 5")), HasSubstr("expected 5 fields"));
  EXPECT_THAT(error(with_atom("ITEM: TIMESTEP")),
              HasSubstr("the next item begins after 1 of the frame's 2 atoms"));
  Dump images;
  images.columns = " id x y z ix iy iz";
  images.atoms = "1 5 5 5 0 0 99999999999\n2 6 6 6 0 0 0\n";
  EXPECT_THAT(error(images), HasSubstr("expected the image flag iz"));
  Dump molecules;
  molecules.columns = " id mol x y z";
  molecules.atoms = "1 4294967296 5 5 5\n2 1 6 6 6\n";
  EXPECT_THAT(error(molecules), HasSubstr("expected a molecule number"));
}

TEST_F(LammpsDumpReader, RefusesBadHeaders) {
  Dump dump;
  dump.step = "7.5";
  EXPECT_THAT(error(dump), AllOf(HasSubstr("line 2"), HasSubstr("expected a time step")));
  for (const char* count : {"-2", "two", "99999999999"}) {
    dump = Dump();
    dump.count = count;
    EXPECT_THAT(error(dump), AllOf(HasSubstr("line 4"), HasSubstr("expected a number of atoms"))) << count;
  }
  dump = Dump();
  dump.columns = " id type x y";
  EXPECT_THAT(error(dump), HasSubstr("no complete set of coordinate columns"));
  dump.columns = " id id x y z";
  EXPECT_THAT(error(dump), HasSubstr("'id' appears twice"));
  for (const char* labels : {" pp pp", " pp pp xx", " pp pf pp", " pp pp pp pp", " xy xz pp pp pp"}) {
    dump = Dump();
    dump.labels = labels;
    EXPECT_THAT(error(dump), HasSubstr("boundary letters")) << labels;
  }
  const std::string text = Dump().text();
  EXPECT_THAT(error(text.substr(text.find("ITEM: NUMBER"))), HasSubstr("no 'ITEM: TIMESTEP'"));
  EXPECT_THAT(error("ITEM: TIMESTEP\n1\n" + text), HasSubstr("a second 'TIMESTEP'"));
  EXPECT_THAT(error("ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS x y z\n1 1 1\n"),
              HasSubstr("no 'ITEM: BOX"));
  EXPECT_THAT(error("ITEM: TIMESTEP\n1\nITEM: BOX BOUNDS\n0 1\n0 1\n0 1\nITEM: ATOMS x y z\n1 1 1\n"),
              HasSubstr("no 'ITEM: NUMBER"));
  EXPECT_THAT(error("ITEM: TIME\nnan\n" + text), HasSubstr("expected a time"));
  EXPECT_THAT(error("ITEM: UNITS\nlj\n"), HasSubstr("holds no frame"));
  EXPECT_THAT(error("\n\n"), HasSubstr("holds no frame"));
}

TEST_F(LammpsDumpReader, RefusesBadBoxes) {
  Dump dump;
  for (const char* box : {"0 20\n0 30\n40 0\n", "0 20\n0 30\n0 0\n", "0 20\n0 30\n5 5\n"}) {
    dump.box = box;
    EXPECT_THAT(error(dump), AllOf(HasSubstr("frame 0, line 8"), HasSubstr("along z; it must be above 0")))
        << box;
  }
  dump.box = "0 20\n0 inf\n0 40\n";
  EXPECT_THAT(error(dump), AllOf(HasSubstr("line 7"), HasSubstr("finite")));
  dump.labels = " xy xz yz pp pp pp";
  dump.box = "0 20 25\n0 30 0\n0 40 0\n";  // 20 - 25 < 0 is left for lx
  EXPECT_THAT(error(dump), AllOf(HasSubstr("line 6"), HasSubstr("extent -5 along x")));
  dump.labels = " abc origin pp pp pp";
  dump.box = "1 0 0 0\n2 0 0 0\n0 0 1 0\n";
  EXPECT_THAT(error(dump), HasSubstr("frame 0, line 8"));
}

TEST_F(LammpsDumpReader, RefusesFramesThatDoNotFitTheFirst) {
  Dump without_ids;
  without_ids.columns = " type x y z";
  without_ids.atoms = "1 5 5 5\n5 6.5 6.5 6.5\n";
  Dump one_more = without_ids;
  one_more.count = "3";
  one_more.atoms += "1 7 7 7\n";
  EXPECT_THAT(error(without_ids.text() + one_more.text()),
              AllOf(HasSubstr("frame 1, line 15"), HasSubstr("3 atoms, the first frame 2")));
  EXPECT_THAT(error(Dump().text() + without_ids.text()), HasSubstr("the frame has no column of ids"));
  EXPECT_THAT(error(without_ids.text() + Dump().text()), HasSubstr("the first frame has none"));
}

TEST_F(LammpsDumpReader, DoesNotAllocateForAtomsThatAreNotThere) {
  Dump dump;
  dump.count = "2000000000";
  EXPECT_THAT(error(dump), HasSubstr("after 2 of the frame's 2000000000 atoms"));
}

}  // namespace
}  // namespace dch::trajectory::test
