// SPDX-License-Identifier: MIT
//
// Hierarchies of cages are empty after an update that memory did not suffice for, and contacts are found
// whole or not at all.
//
// More than 300 lines: one sweep a function of the chains' headers, all on the same melts.
#include <functional>
#include <memory>
#include <numeric>

#include <dch/necklace/contact_events.hpp>
#include <dch/necklace/contact_finder.hpp>
#include <dch/necklace/contact_map.hpp>
#include <dch/necklace/contacts.hpp>
#include <dch/necklace/layered_hierarchy.hpp>
#include <dch/necklace/walks.hpp>
#include <dch/necklace/wrapped_hierarchy.hpp>

#include "contact_oracle.hpp"
#include "scene.hpp"

namespace dch::faults {
namespace {

using namespace necklace;  // NOLINT(google-build-using-namespace)

/// Chains in a box: two long ones, and short ones enough that pairs of them come from a list.
struct Melt {
  Box box = Box::orthorhombic({14, 14, 14});
  Necklace chains;
  std::vector<Vec3> positions;
  ContactQuery query{0.05, 1, true, true};

  explicit Melt(std::size_t short_chains) {
    std::vector<std::size_t> lengths{100, 60};
    lengths.insert(lengths.end(), short_chains, 4);
    scenes::Random random(2);
    std::vector<std::int32_t> molecules;
    std::vector<double> radii;
    for (std::size_t chain = 0; chain < lengths.size(); ++chain) {
      Vec3 at = random.in_cube(7);
      for (std::size_t k = 0; k < lengths[chain]; ++k) {
        Vec3 step = random.in_ball(1);
        while (norm2(step) < 0.1) step = random.in_ball(1);
        at = at + (1 / std::sqrt(norm2(step))) * step;
        positions.push_back(at);
        molecules.push_back(static_cast<std::int32_t>(chain) + 1);
        radii.push_back(chain % 3 == 0 ? 0.5 : 0.2);
      }
    }
    chains = Necklace(Chains::from_molecules(molecules), radii);
  }
  std::vector<Vec3> shaken(double by) const {
    std::vector<Vec3> moved = positions;
    scenes::Random random(3);
    for (Vec3& p : moved) p = p + random.in_ball(by);
    return moved;
  }
  std::vector<IndexPair> expected(const std::vector<Vec3>& at) const {
    return test::contact_oracle(chains, at, box, query);
  }
};

std::string contact_fault(const std::vector<Contact>& found, const std::vector<IndexPair>& expected) {
  return test::pairs_of(found) == expected ? "" : "contacts are missing or too many";
}

/// @param make a hierarchy that holds no positions
template <class Make>
void sweep_updates(const Make& make, double shake, long least_first, long least_later) {
  const Melt melt(3);
  const std::vector<Vec3> moved = melt.shaken(shake), again = melt.shaken(2 * shake);
  const auto expected = melt.expected(moved), expected_again = melt.expected(again);
  using Kept = decltype(make(melt.chains));
  const auto call = [&](Kept& kept) { kept->update(moved, melt.box); };
  const auto fault_of = [&](Kept& kept, Ending ending) -> std::string {
    if (ending == Ending::threw) {
      if (!kept->beads().empty()) return "the hierarchy still has beads";
      call(kept);
    }
    std::string fault = contact_fault(find_contacts(*kept, melt.query), expected);
    if (!fault.empty()) return after(ending, fault);
    kept->update(again, melt.box);
    fault = contact_fault(find_contacts(*kept, melt.query), expected_again);
    return after(ending, fault);
  };
  expect_sound(sweep([&] { return make(melt.chains); }, call, fault_of), least_first);
  expect_sound(sweep(
                   [&] {
                     Kept kept = make(melt.chains);
                     kept->update(melt.positions, melt.box);
                     return kept;
                   },
                   call, fault_of),
               least_later);
}

TEST(NecklaceFaults, AWrappedHierarchyIsEmpty) {
  for (const Verification verification :
       {Verification::cascade, Verification::naive, Verification::watched}) {
    WrappedParams params;
    params.verification = verification;
    const auto make = [&](const Necklace& chains) {
      return std::make_unique<WrappedHierarchy>(chains, params);
    };
    sweep_updates(make, 0.05, 8, 2);
  }
}

TEST(NecklaceFaults, ALayeredHierarchyIsEmpty) {
  sweep_updates([](const Necklace& chains) { return std::make_unique<LayeredHierarchy>(chains); }, 0.05, 6,
                2);
}

TEST(NecklaceFaults, AHierarchyIsMadeOrNot) {
  const Melt melt(3);
  expect_sound(sweep([] { return 0; }, [&](int) { WrappedHierarchy hierarchy(melt.chains); },
                     [](int, Ending) { return std::string(); }),
               10);
}

void sweep_contacts(Executor* executor, std::size_t short_chains, long least_allocations) {
  const Melt melt(short_chains);
  WrappedHierarchy hierarchy(melt.chains);
  hierarchy.update(melt.positions, melt.box);
  const auto expected = melt.expected(melt.positions);
  ASSERT_GE(expected.size(), 20u);
  using Found = std::vector<Contact>;
  const auto call = [&](Found& found) { found = find_contacts(hierarchy, melt.query, nullptr, executor); };
  expect_sound(sweep([] { return Found(); }, call,
                     [&](Found& found, Ending ending) -> std::string {
                       if (ending == Ending::threw && !found.empty()) return "there are contacts";
                       if (ending == Ending::threw) call(found);
                       return after(ending, contact_fault(found, expected));
                     }),
               least_allocations);
  struct Answer {
    bool any = false;
  };
  const auto ask = [&](Answer& answer) {
    answer.any = any_contact(hierarchy, melt.query, nullptr, executor);
  };
  expect_sound(sweep([] { return Answer(); }, ask,
                     [&](Answer& answer, Ending ending) -> std::string {
                       if (ending == Ending::threw) ask(answer);
                       return answer.any ? "" : "no contact was found";
                     }),
               1);
}

TEST(NecklaceFaults, ContactsAreFoundWholeOrNot) {
  sweep_contacts(nullptr, 3, 10);
  sweep_contacts(nullptr, 40, 30);
}
TEST(NecklaceFaults, ContactsOnThreadsAreFoundWholeOrNot) {
  const auto pool = make_thread_pool(2);
  sweep_contacts(pool.get(), 40, 40);
}

TEST(NecklaceFaults, ACertificateIsMadeOrNot) {
  const Melt melt(3);
  WrappedHierarchy hierarchy(melt.chains);
  hierarchy.update(melt.positions, melt.box);
  const auto call = [&](Separation& found) { found = separate(hierarchy, melt.query); };
  expect_sound(sweep([] { return Separation(); }, call,
                     [&](Separation& found, Ending ending) -> std::string {
                       if (ending == Ending::threw && !found.pairs.empty()) return "there are pairs";
                       if (ending == Ending::threw) call(found);
                       return after(ending, check_certificate(hierarchy, melt.query, found));
                     }),
               20);
}

/// By both structures, and when one takes over from the other.
void sweep_finder(Executor* executor, double to_dch) {
  const Melt melt(3);
  const std::vector<Vec3> moved = melt.shaken(0.05);
  const auto expected = melt.expected(melt.positions), expected_moved = melt.expected(moved);
  ContactFinderParams params;
  params.executor = executor;
  params.to_dch = params.to_wrapped = to_dch;
  struct Kept {
    ContactFinder finder;
    std::vector<Contact> found = {};
  };
  ContactQuery wider = melt.query;
  wider.gap = 0.3;  // with a structure of another radius
  const auto wider_expected = test::contact_oracle(melt.chains, melt.positions, melt.box, wider);
  for (const ContactQuery& query : {melt.query, wider}) {
    expect_sound(sweep(
                     [&] {
                       Kept kept{ContactFinder(melt.chains, params)};
                       kept.finder.update(melt.positions, melt.box);
                       kept.finder.find_contacts(melt.query);  // chooses
                       kept.finder.find_contacts(melt.query);
                       return kept;
                     },
                     [&](Kept& kept) { kept.found = kept.finder.find_contacts(query); },
                     [&](Kept& kept, Ending ending) {
                       if (ending == Ending::threw) kept.found = kept.finder.find_contacts(query);
                       std::string fault =
                           contact_fault(kept.found, query.gap == wider.gap ? wider_expected : expected);
                       if (!fault.empty()) return after(ending, fault);
                       fault = contact_fault(kept.finder.find_contacts(melt.query), expected);
                       if (!fault.empty()) return after(ending, "as before: " + fault);
                       kept.finder.update(moved, melt.box);
                       fault = contact_fault(kept.finder.find_contacts(melt.query), expected_moved);
                       return after(ending, fault);
                     }),
                 10);
  }
}

TEST(NecklaceFaults, AContactFinderFindsThemTheNextTime) {
  sweep_finder(nullptr, 0);    // always by the DCH
  sweep_finder(nullptr, 1e9);  // never
}
TEST(NecklaceFaults, AContactFinderOnThreadsFindsThemTheNextTime) {
  const auto pool = make_thread_pool(2);
  sweep_finder(pool.get(), 0);
}

TEST(NecklaceFaults, AContactFinderKeepsItsChainsIfItCannotTakeOthers) {
  const Melt melt(3), other(5);
  const auto expected = melt.expected(melt.positions), other_expected = other.expected(other.positions);
  const auto names_of = [](const Melt& of) {
    std::vector<std::uint64_t> names(of.positions.size());
    std::iota(names.begin(), names.end(), std::uint64_t{7});
    return names;
  };
  const std::vector<std::uint64_t> other_names = names_of(other);
  struct Kept {
    ContactFinder finder;
    bool replaced = false;
  };
  expect_sound(sweep(
                   [&] {
                     ContactFinderParams params;
                     params.to_dch = params.to_wrapped = 0;
                     Kept kept{ContactFinder(Necklace(), params)};
                     kept.finder.replace(melt.chains, names_of(melt));
                     kept.finder.update(melt.positions, melt.box);
                     kept.finder.find_contacts(melt.query);  // from now on the DCH, which is to be kept
                     kept.finder.find_contacts(melt.query);
                     return kept;
                   },
                   [&](Kept& kept) {
                     kept.finder.replace(other.chains, other_names);
                     kept.replaced = true;
                   },
                   [&](Kept& kept, Ending ending) -> std::string {
                     if (kept.replaced != (ending != Ending::threw)) return "it threw after it was done";
                     if (kept.replaced) kept.finder.update(other.positions, other.box);
                     return contact_fault(kept.finder.find_contacts(melt.query),
                                          kept.replaced ? other_expected : expected);
                   }),
               3);
}

TEST(NecklaceFaults, AContactFinderHoldsNothingAfterAnUpdateThatThrew) {
  const Melt melt(3);
  const auto expected = melt.expected(melt.positions);
  expect_sound(sweep([&] { return ContactFinder(melt.chains); },
                     [&](ContactFinder& finder) { finder.update(melt.positions, melt.box); },
                     [&](ContactFinder& finder, Ending ending) -> std::string {
                       if (ending == Ending::threw) {
                         try {
                           finder.find_contacts(melt.query);
                           return "it searched without positions";
                         } catch (const InvalidParameter&) {
                         }
                         finder.update(melt.positions, melt.box);
                       }
                       return contact_fault(finder.find_contacts(melt.query), expected);
                     }),
               2);
}

TEST(NecklaceFaults, ChainsStayAsTheyWere) {
  const std::vector<std::int32_t> first{0, 1, 2}, second{3, 4, 5, 6};
  expect_sound(sweep(
                   [&] {
                     Chains chains(10);
                     chains.add(first);
                     return chains;
                   },
                   [&](Chains& chains) { chains.add(second, true); },
                   [&](Chains& chains, Ending ending) -> std::string {
                     if (ending == Ending::threw) {
                       if (chains.size() != 1 || chains.chain_of(3) != -1) return "there is another chain";
                       chains.add(second, true);
                     }
                     if (chains.size() != 2 || !chains.closed(1)) return "the chain is not there";
                     if (chains.chain_of(6) != 1 || chains.bonds().size() != 6)
                       return "its beads are not there";
                     return "";
                   }),
               4);
}

TEST(NecklaceFaults, ChainsAreMadeOrNot) {
  const Melt melt(3);
  const std::vector<IndexPair> bonds = melt.chains.chains().bonds();
  const auto make = [&](Chains& chains) { chains = Chains::from_bonds(melt.positions.size(), bonds); };
  expect_sound(sweep([] { return Chains(); }, make,
                     [&](Chains& chains, Ending ending) -> std::string {
                       if (ending == Ending::threw && chains.size() != 0) return "there are chains";
                       if (ending == Ending::threw) make(chains);
                       return chains.bonds() == bonds ? "" : "the bonds are others";
                     }),
               20);
  expect_sound(sweep([] { return Necklace(); },
                     [&](Necklace& chains) { chains = Necklace(melt.chains.chains(), 0.5); },
                     [](const Necklace&, Ending) { return std::string(); }),
               8);
}

}  // namespace
}  // namespace dch::faults
