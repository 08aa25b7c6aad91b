// SPDX-License-Identifier: MIT
//
// Contacts by the structure that ContactFinder chooses: those of all pairs in every kind of scene, and the
// same bits, choices and counts in every run, on any number of threads.
#include <cstring>
#include <gmock/gmock.h>
#include <memory>
#include <string>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/necklace/contact_finder.hpp>
#include <dch/necklace/melt.hpp>
#include <dch/necklace/shapes.hpp>
#include <dch/necklace/walks.hpp>

#include "contact_oracle.hpp"
#include "random.hpp"
#include "scenes.hpp"

namespace dch::necklace {
namespace {

struct ChoiceScene {
  std::string name;
  Necklace necklace;
  std::vector<Vec3> positions;
  Box box;
  double gap = 0.1;
  /// What answers once the scene has been measured; null for scenes near the thresholds.
  const Structure* expected = nullptr;
};

constexpr Structure kWrapped = Structure::wrapped, kDch = Structure::dch;

ChoiceScene scene_of(const std::string& name, const Shape& shape, double radius, double gap,
                     const Structure* expected, const Box& box = Box::none()) {
  return {name, necklace_of(shape, radius), shape.positions, box, gap, expected};
}

ChoiceScene melt_scene() {
  MeltParams params;
  params.chains = 24, params.beads_per_chain = 25;
  const Melt melt = make_melt(params);
  return {"melt", Necklace(Chains::from_molecules(melt.molecules), 0.5), melt.positions, melt.box, 0.2,
          &kDch};
}

/// A globule in boxes from just wide enough for its beads on; beads outside are taken as their images.
std::vector<ChoiceScene> boxed_scenes() {
  std::vector<ChoiceScene> scenes;
  for (const double size : {2.7, 9.0})
    for (const scenes::NamedBox& named : scenes::all_boxes(size)) {
      const Shape shape = globule(300, 0.1, 4);
      const double room = named.box.max_cutoff();
      if (room < 1.2) continue;  // bonds are up to 1.35 long; in skewed boxes of that size they lead anywhere
      if (room < 1.4) {          // a narrow box: a chain along z with short bonds
        Shape thread = helix(300, 0.6, 0.7, 0.4);
        scenes.push_back(scene_of("narrow, " + named.name, thread, 0.5, 0.2, nullptr, named.box));
      } else {
        scenes.push_back(scene_of("globule, " + named.name, shape, 0.5, 0.1, nullptr, named.box));
      }
    }
  return scenes;
}

std::vector<ChoiceScene> all_scenes() {
  std::vector<ChoiceScene> scenes = boxed_scenes();
  scenes.push_back(scene_of("globule", globule(700, 0.1, 1), 0.5, 0.1, &kDch));
  scenes.push_back(scene_of("helix", helix(700, 1.5, 0.6, 0.12), 0.5, 0.6, nullptr));
  scenes.push_back(scene_of("stretched", grid_necklace(700, 1, 1), 0.47, 0.1, &kWrapped));
  scenes.push_back(scene_of("swollen", self_avoiding_walk(700, 1, 1), 0.5, 0.3, nullptr));
  scenes.push_back(scene_of("thin", random_walk(700, 3), 0.01, 0.05, nullptr));
  scenes.push_back(scene_of("thin globule", globule(700, 0.5, 2), 0.002, 0.3, nullptr));
  scenes.push_back(scene_of("points", random_walk(700, 5), 0, 0.4, nullptr));
  scenes.push_back(melt_scene());
  return scenes;
}

ContactFinderParams params_on(Executor* threads) {
  ContactFinderParams params;
  params.measure_every = 3;  // so that both have their turn in a packed scene
  params.executor = threads;
  return params;
}

/// The frames of a scene: beads shake by up to 0.02.
std::vector<std::vector<Vec3>> frames_of(const ChoiceScene& scene) {
  scenes::Random random(11);
  std::vector<std::vector<Vec3>> frames{scene.positions};
  while (frames.size() < 7) {
    frames.push_back(frames.back());
    for (Vec3& p : frames.back()) p = p + random.in_ball(0.02);
  }
  return frames;
}

void expect_those_of_all_pairs(const ChoiceScene& scene) {
  SCOPED_TRACE(scene.name);
  ContactFinder finder(scene.necklace, params_on(nullptr));
  const ContactQuery query{scene.gap, 1, true, true};
  int frame = 0;
  std::size_t contacts = 0;
  for (const std::vector<Vec3>& positions : frames_of(scene)) {
    SCOPED_TRACE("frame " + std::to_string(frame));
    finder.update(positions, scene.box);
    const std::vector<Contact> found = finder.find_contacts(query);
    ASSERT_EQ(test::pairs_of(found), test::contact_oracle(scene.necklace, positions, scene.box, query));
    WrappedHierarchy wrapped(scene.necklace);
    wrapped.build(positions, scene.box);
    const std::vector<Contact> alone = find_contacts(wrapped, query);
    EXPECT_TRUE(std::equal(found.begin(), found.end(), alone.begin(), alone.end(), test::same));
    EXPECT_EQ(finder.any_contact(query), !found.empty());
    if (scene.expected != nullptr) {
      EXPECT_EQ(finder.choice().structure, *scene.expected);
    }
    contacts += found.size();
    ++frame;
  }
  EXPECT_EQ(contacts > 0, scene.name != "stretched");
}

TEST(ContactChoice, GivesTheContactsOfAllPairs) {
  const std::vector<ChoiceScene> scenes = all_scenes();
  ASSERT_GT(scenes.size(), 16U);
  for (const ChoiceScene& scene : scenes) expect_those_of_all_pairs(scene);
}

/// FNV-1a over what a run gave: contacts with all their bits, who answered, why, and what was counted.
class RunHash {
 public:
  template <class T>
  void add(const T& value) {
    unsigned char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    for (const unsigned char byte : bytes) hash_ = (hash_ ^ byte) * 1099511628211U;
  }
  void add(const Contact& contact) {
    add(contact.i), add(contact.j), add(contact.gap);
    for (int axis = 0; axis < 3; ++axis) add(contact.on_i[axis]), add(contact.on_j[axis]);
  }
  void add(const std::string& text) {
    for (const char letter : text) add(letter);
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 14695981039346656037U;
};

std::uint64_t hash_of_run(const ChoiceScene& scene, Executor* threads) {
  ContactFinder finder(scene.necklace, params_on(threads));
  RunHash hash;
  for (const std::vector<Vec3>& positions : frames_of(scene)) {
    finder.update(positions, scene.box);
    for (const Contact& contact : finder.find_contacts({scene.gap, 1, true, true})) hash.add(contact);
    hash.add(finder.answered_by());
    hash.add(finder.choice().reason);
    hash.add(finder.choice().visited_per_bead);
    const WrappedStats& stats = finder.wrapped().stats();
    for (const std::int64_t count :
         {stats.updates, stats.containment_tests, stats.escapes, stats.basis_changes})
      hash.add(count);
  }
  return hash.value();
}

TEST(ContactChoice, FiveRunsOnAnyNumberOfThreadsGiveOneHash) {
  const int threads[] = {1, 2, 3, 5, 2};
  for (const ChoiceScene& scene : all_scenes()) {
    const std::uint64_t expected = hash_of_run(scene, nullptr);
    for (const int count : threads)
      EXPECT_EQ(hash_of_run(scene, make_thread_pool(count).get()), expected)
          << scene.name << " on " << count << " threads";
  }
}

/// A finder that was asked to prepare gives what one gives that was not, whoever has its turn.
TEST(ContactChoice, PreparingChangesNothing) {
  const ChoiceScene scene = scene_of("globule", globule(400, 0.1, 1), 0.5, 0.1, &kDch);
  ContactFinder plain(scene.necklace, params_on(nullptr)), prepared(scene.necklace, params_on(nullptr));
  const ContactQuery query{scene.gap, 1, true, true};
  for (const std::vector<Vec3>& positions : frames_of(scene)) {
    plain.update(positions, scene.box);
    prepared.update(positions, scene.box);
    prepared.prepare(query);
    prepared.prepare(query);
    const auto expected = plain.find_contacts(query), found = prepared.find_contacts(query);
    EXPECT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end(), test::same));
    EXPECT_EQ(prepared.answered_by(), plain.answered_by());
  }
}

/// In a packed scene the DCH answers, but for the first search and one in measure_every.
TEST(ContactChoice, SaysWhoAnswered) {
  const ChoiceScene scene = scene_of("globule", globule(400, 0.1, 1), 0.5, 0.1, &kDch);
  ContactFinder finder(scene.necklace, params_on(nullptr));
  EXPECT_EQ(finder.answered_by(), kWrapped);
  std::string answers;
  for (const std::vector<Vec3>& positions : frames_of(scene)) {
    finder.update(positions, scene.box);
    finder.find_contacts({scene.gap, 1, true, true});
    answers += name_of(finder.answered_by())[0];
  }
  EXPECT_EQ(answers, "wddwddw");
  EXPECT_THAT(finder.choice().reason, testing::HasSubstr("above 1.80: the DCH"));
}

}  // namespace
}  // namespace dch::necklace
