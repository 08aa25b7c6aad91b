// SPDX-License-Identifier: MIT
#include "input/chain_topology.hpp"

#include <gmock/gmock.h>

#include <dch/trajectory/file_error.hpp>

#include "base/exit_code.hpp"
#include "expect_error.hpp"
#include "temporary_folder.hpp"

namespace dch::cli {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using trajectory::FileError;

class ChainTopology : public TemporaryFolder {
 protected:
  ChainTopology() {
    frame_.ids = {2, 3, 5, 7, 11, 13, 17};
    frame_.types = {1, 1, 1, 2, 2, 3, 3};
    for (double id : {2, 3, 5, 7, 11, 13, 17}) frame_.positions.push_back({id, 0, 0});
  }

  BeadChains chains(const std::string& name, const std::string& text) {
    create(path(name), text);
    return read_bead_chains("run.dump", path(name), frame_);
  }
  /// Ids along a chain.
  static std::vector<std::int64_t> ids(const BeadChains& beads, std::size_t chain) {
    std::vector<std::int64_t> result;
    for (const std::int32_t bead : beads.chains.beads(chain)) {
      result.push_back(beads.ids[static_cast<std::size_t>(bead)]);
    }
    return result;
  }

  trajectory::Frame frame_;
};

TEST_F(ChainTopology, KeepsTheOrderOfChainsFiles) {
  const BeadChains beads = chains("some.chains", "13 5\nring 11 17 2 # closed\n3\n");
  EXPECT_THAT(beads.ids, ElementsAre(2, 3, 5, 11, 13, 17));
  EXPECT_THAT(beads.types, ElementsAre(1, 1, 1, 2, 3, 3));
  EXPECT_EQ(beads.source, path("some.chains"));
  ASSERT_EQ(beads.chains.size(), 3U);
  EXPECT_THAT(ids(beads, 0), ElementsAre(13, 5));
  EXPECT_THAT(ids(beads, 1), ElementsAre(11, 17, 2));
  EXPECT_THAT(ids(beads, 2), ElementsAre(3));
  EXPECT_FALSE(beads.chains.closed(0));
  EXPECT_TRUE(beads.chains.closed(1));
}

TEST_F(ChainTopology, MakesChainsOfBonds) {
  const BeadChains beads = chains("some.bonds", "17 3\n3 5\n7 11\n11 13\n13 7\n");
  ASSERT_EQ(beads.chains.size(), 2U);
  EXPECT_THAT(ids(beads, 0), ElementsAre(5, 3, 17));
  EXPECT_THAT(ids(beads, 1), ElementsAre(7, 11, 13));
  EXPECT_TRUE(beads.chains.closed(1));
  EXPECT_EQ(beads.ids.size(), 6U);
  frame_.types.clear();
  EXPECT_THAT(chains("data.two", "title\n1 bonds\n\nBonds\n\n1 1 3 2\n").ids, ElementsAre(2, 3));
}

TEST_F(ChainTopology, MakesChainsOfMolecules) {
  frame_.molecules = {4, 0, 4, 2, 9, 2, 4};
  const BeadChains beads = read_bead_chains("run.dump", {}, frame_);
  ASSERT_EQ(beads.chains.size(), 2U) << "one atom alone is none";
  EXPECT_THAT(ids(beads, 0), ElementsAre(2, 5, 17));
  EXPECT_THAT(ids(beads, 1), ElementsAre(7, 13));
  EXPECT_THAT(beads.source, testing::HasSubstr("run.dump"));
}

TEST_F(ChainTopology, TakesTheMoleculesAskedFor) {
  frame_.molecules = {4, 0, 4, 2, 9, 2, 4};
  EXPECT_THAT(read_bead_chains("run.dump", ChainSource("", "2", ""), frame_).ids, ElementsAre(7, 13));
  EXPECT_THAT(read_bead_chains("run.dump", ChainSource("", "1-3,9", ""), frame_).ids, ElementsAre(7, 13));
  EXPECT_EQ(read_bead_chains("run.dump", ChainSource("", "2,3-4", ""), frame_).chains.size(), 2U);
  expect_error<UsageError>([&] { read_bead_chains("run.dump", ChainSource("", "2,5-8", ""), frame_); },
                           {"run.dump has no molecule 5-8"});
  for (const char* wrong : {"x", "2-", "-2", "0", "3-2", "2,,4", "1.5", "2147483648"}) {
    expect_error<UsageError>([&] { ChainSource("", wrong, ""); }, {"--molecules", "1,4-7"});
  }
}

TEST_F(ChainTopology, CutsAtomsIntoChainsOfOneLength) {
  const BeadChains beads = read_bead_chains("run.dump", ChainSource("", "", "7"), frame_);
  EXPECT_EQ(beads.chains.size(), 1U);
  EXPECT_EQ(beads.ids, frame_.ids);
  expect_error<UsageError>([&] { read_bead_chains("run.dump", ChainSource("", "", "2"), frame_); },
                           {"--chain-length 2", "7 atoms", "--topology"});
  for (const char* wrong : {"1", "0", "-3", "x", "2.5"}) {
    expect_error<UsageError>([&] { ChainSource("", "", wrong); }, {"--chain-length", "from 2"});
  }
  expect_error<UsageError>([] { ChainSource("a.chains", "1", ""); }, {"--topology", "one of them"});
  expect_error<UsageError>([] { ChainSource("", "1", "3"); }, {"--molecules", "one of them"});
}

TEST_F(ChainTopology, RefusesChainsThatAreNone) {
  const auto refused = [&](const std::string& name, const std::string& text,
                           std::initializer_list<std::string> parts) {
    expect_error<FileError>([&] { chains(name, text); }, parts);
  };
  refused("a.chains", "2 3\n5 7 3\n",
          {"a.chains: line 2", "the id 3 stands in the chain of line 1 already", "one chain at most"});
  refused("a.chains", "\n2 3 5 2\n", {"line 2", "the id 2 stands in this chain twice", "ring in front"});
  refused("a.chains", "2 4\n", {"line 1", "no atom with the id 4"});
  refused("a.chains", "# nothing\n", {"a.chains", "no bonds and no chains", "--topology"});
  refused("a.chains", "", {"a.chains", "is empty"});
  refused("a.bonds", "2 3\n3 2\n", {"the ids 2 and 3 is given twice"});
  refused("a.bonds", "2 3\n3 5\n7 3\n", {"the id 3 has three bonds or more", ".chains"});
  refused("data.a", "title\n0 bonds\n", {"no bonds and no chains"});
  expect_error<FileError>([&] { read_bead_chains("run.dump", path("missing.chains"), frame_); },
                          {"missing.chains", "No such file"});
  expect_error<UsageError>([&] { read_bead_chains("run.dump", {}, frame_); },
                           {"run.dump has no molecule column", "--topology"});
  frame_.molecules = {1, 2, 3, 4, 5, 6, 0};
  expect_error<FileError>([&] { read_bead_chains("run.dump", {}, frame_); }, {"run.dump", "no bonds"});
}

TEST_F(ChainTopology, FindsBeadsAmongOtherAtoms) {
  const BeadChains beads = chains("two.chains", "11 3\n");
  BeadFinder finder("run.dump", beads);
  EXPECT_THAT(finder.positions(frame_, 0), ElementsAre(Vec3{3, 0, 0}, Vec3{11, 0, 0}));
  trajectory::Frame other;
  other.ids = {1, 3, 4, 11};
  other.positions = {{0, 1, 0}, {0, 3, 0}, {0, 4, 0}, {0, 11, 0}};
  EXPECT_THAT(finder.positions(other, 1), ElementsAre(Vec3{0, 3, 0}, Vec3{0, 11, 0}));
  EXPECT_THAT(finder.last_positions(), ElementsAre(Vec3{0, 3, 0}, Vec3{0, 11, 0}));
  other.ids.back() = 12;
  expect_error<FileError>(
      [&] { finder.positions(other, 2); },
      {"run.dump: frame 2: has 4 atoms and none with the id 11", "two.chains", "--frames"});
}

}  // namespace
}  // namespace dch::cli
