// SPDX-License-Identifier: MIT
#include "contenders.hpp"

#include <algorithm>
#include <utility>

#include <dch/engines/pair_search.hpp>
#include <dch/necklace/contact_finder.hpp>
#include <dch/necklace/layered_hierarchy.hpp>
#include <dch/necklace/wrapped_hierarchy.hpp>
#ifdef DCH_BENCH_HAS_POWER_DIAGRAM
#include <dch/necklace/closest_pair.hpp>
#include <dch/power_diagram/power_diagram.hpp>
#endif

namespace dch::bench {

namespace {

using necklace::CageHierarchy;
using necklace::LayeredHierarchy;
using necklace::WrappedHierarchy;

std::int64_t ask_cages(const CageHierarchy& hierarchy, const QueryScene& scene) {
  if (scene.yes_or_no) return any_contact(hierarchy, scene.query(), nullptr, scene.executor) ? 1 : 0;
  return static_cast<std::int64_t>(find_contacts(hierarchy, scene.query(), nullptr, scene.executor).size());
}

std::vector<IndexPair> contacts_of_cages(const CageHierarchy& hierarchy, const QueryScene& scene) {
  std::vector<IndexPair> pairs;
  for (const necklace::Contact& contact : find_contacts(hierarchy, scene.query())) {
    pairs.push_back({contact.i, contact.j});
  }
  return pairs;
}

/// Kept up, or built for each update.
class Wrapped : public Contender {
 public:
  Wrapped(const QueryScene& scene, bool keep) : scene_(scene), keep_(keep), hierarchy_(scene.necklace()) {}
  std::string name() const override { return keep_ ? "wrapped" : "wrapped, built"; }
  void update(const std::vector<Vec3>& positions) override {
    if (keep_) {
      hierarchy_.update(positions, Box::none());
    } else {
      hierarchy_.build(positions, Box::none());
    }
  }
  std::int64_t ask() override { return ask_cages(hierarchy_, scene_); }
  std::vector<IndexPair> contacts() override { return contacts_of_cages(hierarchy_, scene_); }

 private:
  const QueryScene& scene_;
  bool keep_;
  WrappedHierarchy hierarchy_;
};

class Layered : public Contender {
 public:
  explicit Layered(const QueryScene& scene) : scene_(scene), hierarchy_(scene.necklace()) {}
  std::string name() const override { return "layered"; }
  void update(const std::vector<Vec3>& positions) override { hierarchy_.update(positions, Box::none()); }
  std::int64_t ask() override { return ask_cages(hierarchy_, scene_); }
  std::vector<IndexPair> contacts() override { return contacts_of_cages(hierarchy_, scene_); }

 private:
  const QueryScene& scene_;
  LayeredHierarchy hierarchy_;
};

/// A search for near pairs, bonded ones left out. It knows no early end.
class Search : public Contender {
 public:
  Search(const QueryScene& scene, std::string name, std::unique_ptr<PairSearch> search)
      : scene_(scene),
        name_(std::move(name)),
        exclusions_(Exclusions::from_bonds(scene.frames[0].size(), scene.necklace().chains().bonds(), 1)),
        search_(std::move(search)) {
    params_.cutoffs = TypeCutoffs(scene.reach());
    params_.exclusions = &exclusions_;
    params_.order = RowOrder::unsorted;
  }
  std::string name() const override { return name_; }
  void update(const std::vector<Vec3>& positions) override { search_->update(positions, Box::none()); }
  std::int64_t ask() override {
    search_->list(params_, list_);
    return scene_.yes_or_no ? (list_.pairs() > 0 ? 1 : 0) : list_.pairs();
  }
  std::vector<IndexPair> contacts() override {
    search_->list(params_, list_);
    std::vector<IndexPair> pairs;
    for (std::size_t row = 0; row < list_.size(); ++row) {
      const auto i = list_.particle.empty() ? static_cast<std::int32_t>(row) : list_.particle[row];
      for (const std::int32_t j : list_.row(row)) pairs.push_back({std::min(i, j), std::max(i, j)});
    }
    return pairs;
  }

 private:
  const QueryScene& scene_;
  std::string name_;
  Exclusions exclusions_;
  std::unique_ptr<PairSearch> search_;
  ListParams params_;
  NeighborList list_;
};

/// What the scene choice takes.
class Finder : public Contender {
 public:
  explicit Finder(const QueryScene& scene) : scene_(scene), finder_(scene.necklace(), params_of(scene)) {}
  std::string name() const override { return "scene choice"; }
  void update(const std::vector<Vec3>& positions) override { finder_.update(positions, Box::none()); }
  std::int64_t ask() override {
    if (scene_.yes_or_no) return finder_.any_contact(scene_.query()) ? 1 : 0;
    return static_cast<std::int64_t>(finder_.find_contacts(scene_.query()).size());
  }
  std::vector<IndexPair> contacts() override {
    std::vector<IndexPair> pairs;
    for (const auto& contact : finder_.find_contacts(scene_.query())) pairs.push_back({contact.i, contact.j});
    return pairs;
  }
  std::string note() const override { return finder_.choice().reason; }

 private:
  static necklace::ContactFinderParams params_of(const QueryScene& scene) {
    necklace::ContactFinderParams params;
    params.executor = scene.executor;
    return params;
  }

  const QueryScene& scene_;
  necklace::ContactFinder finder_;
};

#ifdef DCH_BENCH_HAS_POWER_DIAGRAM
/// The closest pair tells whether there is a contact, but not which ones.
class Diagram : public Contender {
 public:
  explicit Diagram(const QueryScene& scene)
      : scene_(scene), closest_(scene.necklace(), std::make_unique<necklace::PowerDiagram>()) {}
  std::string name() const override { return "power diagram"; }
  void update(const std::vector<Vec3>& positions) override { closest_.update(positions, Box::none()); }
  std::int64_t ask() override { return closest_.find(1)->gap <= scene_.gap ? 1 : 0; }
  std::vector<IndexPair> contacts() override { return {}; }
  bool lists() const override { return false; }
  std::string note() const override {
    const auto& stats = dynamic_cast<const necklace::PowerDiagram&>(closest_.diagram()).stats();
    return std::to_string(stats.repairs) + " repairs, " + std::to_string(stats.builds) + " builds";
  }

 private:
  const QueryScene& scene_;
  necklace::ClosestPair closest_;
};
#endif

}  // namespace

necklace::Necklace QueryScene::necklace() const {
  return necklace::Necklace::chain(std::vector<double>(frames[0].size(), radius));
}

std::vector<std::unique_ptr<Contender>> make_contenders(const QueryScene& scene) {
  HierarchyParams dch;
  dch.radius = scene.reach();
  dch.executor = scene.executor;
  std::vector<std::unique_ptr<Contender>> contenders;
  contenders.push_back(std::make_unique<Search>(scene, "cell list", make_cell_search(scene.reach())));
  contenders.push_back(std::make_unique<Search>(scene, "DCH", make_dch_search(dch)));
  contenders.push_back(std::make_unique<Wrapped>(scene, true));
  contenders.push_back(std::make_unique<Wrapped>(scene, false));
  contenders.push_back(std::make_unique<Layered>(scene));
  contenders.push_back(std::make_unique<Finder>(scene));
#ifdef DCH_BENCH_HAS_POWER_DIAGRAM
  if (scene.yes_or_no) contenders.push_back(std::make_unique<Diagram>(scene));
#endif
  return contenders;
}

}  // namespace dch::bench
