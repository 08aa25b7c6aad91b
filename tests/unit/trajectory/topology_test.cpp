// SPDX-License-Identifier: MIT
#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

#include <dch/trajectory/topology.hpp>

#include "reading.hpp"
#include "scratch_folder.hpp"

namespace dch::trajectory::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ReadTopology : public testing::Test {
 protected:
  std::vector<IndexPair> bonds(const std::string& name, const std::string& text) {
    return read_topology(folder_.write(name, text), ids_).bonds;
  }
  std::string error(const std::string& name, const std::string& text) {
    try {
      bonds(name, text);
    } catch (const FileError& problem) {
      return problem.what();
    }
    return "";
  }

  ScratchFolder folder_;
  std::vector<std::int64_t> ids_{1, 2, 3, 5, 10, 11, 12};
};

constexpr const char* kData =
    "LAMMPS data file, 9 bonds\n\n"
    "7 atoms\n2 bonds # comment\n1 bond types\n\n"
    "0 1 xlo xhi\n\n"
    "Bond Coeffs # harmonic\n\n1 30 1.5\n\n"
    "Atoms # full\n\n1 1 1 0 0 0 0\n\n"
    "Bonds # or not\n\n1 1 10 2\n2 polymer 5 3 # last\n\nAngles\n\n1 1 1 2 3\n";

TEST_F(ReadTopology, ReadsLammpsDataFiles) {
  for (const char* name : {"test.data", "test.lmp", "data.test", "DATA.TEST"}) {
    EXPECT_THAT(bonds(name, kData), ElementsAre(IndexPair{4, 1}, IndexPair{3, 2})) << name;
  }
  EXPECT_EQ(read_topology(folder_.path("test.data"), ids_).source, folder_.path("test.data"));
  EXPECT_THAT(bonds("none.data", "title\n0 bonds\n"), IsEmpty());
  EXPECT_THAT(bonds("none.data", "title\n7 atoms\n\nAtoms\n\n"), IsEmpty());
}

TEST_F(ReadTopology, RefusesBrokenLammpsDataFiles) {
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = kData;
    text.replace(text.find(from), from.size(), to);
    return error("test.data", text);
  };
  EXPECT_THAT(with("2 bonds #", "3 bonds #"),
              AllOf(HasSubstr("test.data: line 22"), HasSubstr("of 3), found 1 words")));
  EXPECT_THAT(with("2 bonds #", "1 bonds #"), AllOf(HasSubstr("line 20"), HasSubstr("there are more")));
  EXPECT_THAT(with("2 bonds #", "#"), AllOf(HasSubstr("line 17"), HasSubstr("does not say how many")));
  EXPECT_THAT(with("2 bonds #", "-2 bonds #"), AllOf(HasSubstr("line 4"), HasSubstr("found '-2'")));
  EXPECT_THAT(with("1 1 10 2\n", "1 1 10\n"), AllOf(HasSubstr("line 19"), HasSubstr("found 3 words")));
  EXPECT_THAT(with("1 1 10 2\n", "1 1 10 x\n"),
              AllOf(HasSubstr("line 19"), HasSubstr("id of an atom, found 'x'")));
  EXPECT_THAT(with("1 1 10 2\n", "1 1 10 4\n"),
              AllOf(HasSubstr("line 19"), HasSubstr("no atom with the id 4")));
  EXPECT_THAT(with("1 1 10 2\n", "1 1 10 10\n"), AllOf(HasSubstr("line 19"), HasSubstr("with itself")));
  const std::string text = kData;
  EXPECT_THAT(error("test.data", text.substr(0, text.find("2 polymer"))),
              HasSubstr("after 1 of 2 bonds: it is truncated"));
  EXPECT_THAT(error("test.data", text.substr(0, text.find(" # last"))), HasSubstr("ends inside this line"));
  EXPECT_THAT(error("test.data", text.substr(0, text.find("Bonds #"))),
              HasSubstr("without the section 'Bonds'"));
}

TEST_F(ReadTopology, ReadsBonds) {
  EXPECT_THAT(bonds("test.bonds", "# two bonds\n\n1 2\n\t10 5 # second"),
              ElementsAre(IndexPair{0, 1}, IndexPair{4, 3}));
  EXPECT_THAT(bonds("test.bonds", "#\n"), IsEmpty());
  for (const char* line : {"1", "1 2 3", "1-2"}) {
    EXPECT_THAT(error("test.bonds", std::string("1 2\n") + line),
                AllOf(HasSubstr("line 2"), HasSubstr("two atoms")));
  }
  EXPECT_THAT(error("test.bonds", "1 x\n"), AllOf(HasSubstr("line 1"), HasSubstr("found 'x'")));
  EXPECT_THAT(error("test.bonds", "1 13\n"),
              HasSubstr("no atom with the id 13 (it has 7 atoms with ids from 1 to 12)"));
  EXPECT_THAT(error("test.bonds", "3 3\n"), HasSubstr("with itself"));
}

TEST_F(ReadTopology, ReadsChains) {
  EXPECT_THAT(
      bonds("test.chains", "5 1 10 # linear\n\nring 2 3 12\n11\n"),
      ElementsAre(IndexPair{3, 0}, IndexPair{0, 4}, IndexPair{1, 2}, IndexPair{2, 6}, IndexPair{6, 1}));
  EXPECT_THAT(
      bonds("test.chains", "1-3 12-10"),
      ElementsAre(IndexPair{0, 1}, IndexPair{1, 2}, IndexPair{2, 6}, IndexPair{6, 5}, IndexPair{5, 4}));
  EXPECT_THAT(error("test.chains", "1\nring 1 2\n"),
              AllOf(HasSubstr("line 2"), HasSubstr("three atoms at least, found 2")));
  EXPECT_THAT(error("test.chains", "1 2 2\n"), HasSubstr("with itself"));
  EXPECT_THAT(error("test.chains", "1 ring 2\n"), HasSubstr("found 'ring'"));
  EXPECT_THAT(error("test.chains", "1-x\n"), HasSubstr("range of ids such as 7-12, found '1-x'"));
  EXPECT_THAT(error("test.chains", "1-9000000000000000000\n"), HasSubstr("no atom with the id 4"));
}

TEST_F(ReadTopology, KeepsChainsAsTheFileOrdersThem) {
  const Topology topology = read_topology(
      folder_.write("test.chains", "# three chains\n5 1 10\n\nring 12-11 2\n3 # alone\n"), ids_);
  ASSERT_EQ(topology.chains.size(), 3U);
  EXPECT_THAT(topology.chains[0].atoms, ElementsAre(3, 0, 4));
  EXPECT_FALSE(topology.chains[0].closed);
  EXPECT_EQ(topology.chains[0].line, 2);
  EXPECT_THAT(topology.chains[1].atoms, ElementsAre(6, 5, 1));
  EXPECT_TRUE(topology.chains[1].closed);
  EXPECT_THAT(topology.chains[2].atoms, ElementsAre(2));
  EXPECT_EQ(topology.chains[2].line, 5);
  EXPECT_THAT(read_topology(folder_.write("test.bonds", "1 2\n"), ids_).chains, IsEmpty());
}

TEST_F(ReadTopology, RefusesOtherFiles) {
  EXPECT_THAT(error("test.psf", "PSF\n"),
              AllOf(HasSubstr("test.psf"), HasSubstr("unknown kind of topology")));
  try {
    read_topology(folder_.path("missing.bonds"), ids_);
    ADD_FAILURE();
  } catch (const FileError& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("No such file"));
  }
}

TEST(TopologyFromMolecules, ChainsAtomsInOrderOfId) {
  Frame frame;
  frame.positions.resize(7);
  frame.ids = {1, 2, 3, 5, 8, 9, 11};
  frame.molecules = {4, 0, 4, 2, 0, 2, 4};
  const Topology topology = topology_from_molecules(frame, "test.dump");
  EXPECT_THAT(topology.bonds, ElementsAre(IndexPair{3, 5}, IndexPair{0, 2}, IndexPair{2, 6}));
  EXPECT_THAT(topology.source, HasSubstr("test.dump"));
  frame.molecules.clear();
  EXPECT_THROW(topology_from_molecules(frame, "test.dump"), FileError);
}

TEST(TopologyFromMolecules, ReadsThePolymer) {
  const auto frames = read_all(data_path("polymer.lammpstrj"));
  const Topology topology = topology_from_molecules(frames[0], "polymer.lammpstrj");
  std::set<std::int32_t> molecules(frames[0].molecules.begin(), frames[0].molecules.end());
  molecules.erase(0);
  const auto loose = std::count(frames[0].molecules.begin(), frames[0].molecules.end(), 0);
  EXPECT_EQ(topology.bonds.size(), frames[0].ids.size() - static_cast<std::size_t>(loose) - molecules.size());
}

}  // namespace
}  // namespace dch::trajectory::test
