// SPDX-License-Identifier: MIT
#include "input/bead_radii.hpp"

#include <gmock/gmock.h>

#include "base/exit_code.hpp"
#include "expect_error.hpp"

namespace dch::cli {
namespace {

using testing::ElementsAre;

BeadChains three_beads() {
  BeadChains beads;
  beads.ids = {4, 6, 9};
  beads.types = {2, 1, 2};
  return beads;
}

TEST(BeadRadii, AreOneForAllOrGoByType) {
  EXPECT_THAT(BeadRadii("0.5").of(three_beads(), "run.dump"), ElementsAre(0.5, 0.5, 0.5));
  EXPECT_THAT(BeadRadii("0").of(three_beads(), "run.dump"), ElementsAre(0, 0, 0));
  EXPECT_THAT(BeadRadii("1=0.25,2=1").of(three_beads(), "run.dump"), ElementsAre(1, 0.25, 1));
  EXPECT_THAT(BeadRadii("2=1,7=3,1=0").of(three_beads(), "run.dump"), ElementsAre(1, 0, 1));
}

TEST(BeadRadii, RefuseWhatIsNoRadius) {
  const auto refused = [](const std::string& text, std::initializer_list<std::string> parts) {
    expect_error<UsageError>([&] { (void)BeadRadii(text); }, parts);
  };
  refused("", {"--radius ''", "not a finite number"});
  refused("x", {"--radius 'x'", "1=0.5,2=0.7"});
  refused("-1", {"--radius -1", "at least 0"});
  refused("nan", {"--radius 'nan'"});
  refused("1=", {"--radius ''", "not a finite number"});
  refused("1=0.5,", {"--radius ''", "not a whole number"});
  refused("1=0.5,2", {"--radius ''"});
  refused("a=0.5", {"--radius 'a'", "not a whole number"});
  refused("1=0.5=3", {"--radius '0.5=3'"});
  refused("1=0.5,1=0.7", {"names the type 1 twice"});
  refused("1=-0.5", {"--radius -0.5", "at least 0"});
}

TEST(BeadRadii, RefuseTypesThatAreNotThere) {
  expect_error<UsageError>([] { BeadRadii("1=0.5").of(three_beads(), "run.dump"); },
                           {"none for the type 2", "the id 4", "add 2=R"});
  BeadChains beads = three_beads();
  beads.types.clear();
  expect_error<UsageError>([&] { BeadRadii("1=0.5").of(beads, "run.dump"); },
                           {"run.dump has no types", "one radius for all"});
}

}  // namespace
}  // namespace dch::cli
