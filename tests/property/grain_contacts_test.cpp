// SPDX-License-Identifier: MIT
//
// Forces of contacts of grains equal those of a plain loop, which is written from the formulas of Cundall and
// Strack, in long double.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include <dch/base/error.hpp>
#include <dch/forces/grain_contacts.hpp>

#include "instruction_sets.hpp"
#include "lj_oracle.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr ContactForm kForms[] = {ContactForm::hooke, ContactForm::hooke_history, ContactForm::hertz_history};

struct Heap {
  std::vector<Vec3> positions, velocities, spins;
  std::vector<GrainBody> bodies;
  std::vector<std::int32_t> i, j, touching;
  std::vector<Vec3> slips;
};

/// Grains side by side, about half of the pairs touching; each pair is listed once, and so are some far ones.
Heap heap_of(std::size_t pairs, bool some_frozen) {
  scenes::Random random(7);
  Heap heap;
  const std::size_t grains = std::max<std::size_t>(pairs / 3, 2);
  for (std::size_t k = 0; k < grains; ++k) {
    heap.positions.push_back(random.in_ball(1.2));
    heap.velocities.push_back(random.in_ball(3));
    heap.spins.push_back(random.in_ball(5));
    heap.bodies.push_back({0.3 + 0.1 * static_cast<double>(k % 5), 0.5 + 0.25 * static_cast<double>(k % 4),
                           some_frozen && k % 3 == 0 ? 1.0 : 0.0});
  }
  for (std::size_t k = 0; k < pairs; ++k) {
    const auto first = static_cast<std::int32_t>(k % grains);
    const auto second = static_cast<std::int32_t>((k + 1 + k / grains) % grains);
    heap.i.push_back(first);
    heap.j.push_back(second == first ? (first + 1) % static_cast<std::int32_t>(grains) : second);
    heap.touching.push_back(static_cast<std::int32_t>(k % 2));
    heap.slips.push_back(k % 2 == 1 ? random.in_ball(0.02) : Vec3{});
  }
  return heap;
}

struct Wide {
  long double x, y, z;
  Wide(long double a, long double b, long double c) : x(a), y(b), z(c) {}
  explicit Wide(const Vec3& a) : x(a.x), y(a.y), z(a.z) {}
  friend Wide operator+(const Wide& a, const Wide& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Wide operator-(const Wide& a, const Wide& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Wide operator*(long double f, const Wide& a) { return {f * a.x, f * a.y, f * a.z}; }
  long double dot(const Wide& b) const { return x * b.x + y * b.y + z * b.z; }
  long double length() const { return std::sqrt(dot(*this)); }
  Wide cross(const Wide& b) const { return {y * b.z - z * b.y, z * b.x - x * b.z, x * b.y - y * b.x}; }
  Vec3 rounded() const { return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}; }
};

/// What kernels should write.
struct Outcome {
  std::vector<Vec3> forces, torques, slips;
  std::vector<std::int32_t> touching;
};

Outcome plain_contacts(const Heap& heap, const ContactParams& params, double timestep, std::size_t owned) {
  Outcome all{std::vector<Vec3>(heap.positions.size()), std::vector<Vec3>(heap.positions.size()), heap.slips,
              heap.touching};
  for (std::size_t k = 0; k < heap.i.size(); ++k) {
    const auto i = static_cast<std::size_t>(heap.i[k]), j = static_cast<std::size_t>(heap.j[k]);
    const GrainBody &a = heap.bodies[i], &b = heap.bodies[j];
    const Wide d = Wide(heap.positions[i]) - Wide(heap.positions[j]);
    const long double r = d.length(), reach = static_cast<long double>(a.radius) + b.radius;
    all.touching[k] = r < reach;
    if (r >= reach) {
      all.slips[k] = {};
      continue;
    }
    const Wide normal = (1 / r) * d;
    long double mass =
        a.mass * static_cast<long double>(b.mass) / (static_cast<long double>(a.mass) + b.mass);
    if (a.frozen != 0) mass = b.mass;
    if (b.frozen != 0) mass = a.mass;
    const Wide v = Wide(heap.velocities[i]) - Wide(heap.velocities[j]);
    const long double along = v.dot(normal);
    const Wide spin = static_cast<long double>(a.radius) * Wide(heap.spins[i]) +
                      static_cast<long double>(b.radius) * Wide(heap.spins[j]);
    const Wide across = v - along * normal - spin.cross(normal);
    const bool is_hertz = params.form == ContactForm::hertz_history;
    const long double hertz = is_hertz ? std::sqrt((reach - r) * a.radius * b.radius / reach) : 1;
    long double push = hertz * (params.stiffness * (reach - r) - mass * params.damping * along);
    if (push < 0 && params.limits_damping) push = 0;
    const long double most = params.friction * std::abs(push);
    Wide friction{0, 0, 0};
    if (params.form == ContactForm::hooke) {
      const long double drag = mass * params.shear_damping * across.length();
      if (across.length() > 0) friction = (-std::min(most, drag) / across.length()) * across;
    } else {
      Wide slip(heap.slips[k]);
      if (timestep >= 0) {
        slip = slip + static_cast<long double>(timestep) * across;
        slip = slip - slip.dot(normal) * normal;
      }
      const Wide damping = (mass * params.shear_damping) * across;
      friction = -hertz * (static_cast<long double>(params.shear_stiffness) * slip + damping);
      if (const long double wanted = friction.length(); wanted > most) {
        if (slip.length() > 0) {
          const Wide shift = (1 / static_cast<long double>(params.shear_stiffness)) * damping;
          slip = (most / wanted) * (slip + shift) - shift;
          friction = (most / wanted) * friction;
        } else {
          friction = {0, 0, 0};
        }
      }
      all.slips[k] = slip.rounded();
    }
    const Vec3 force = (push * normal + friction).rounded(), torque = normal.cross(friction).rounded();
    all.forces[i] = all.forces[i] + force;
    all.torques[i] = all.torques[i] - a.radius * torque;
    if (j >= owned) continue;
    all.forces[j] = all.forces[j] - force;
    all.torques[j] = all.torques[j] - b.radius * torque;
  }
  return all;
}

Outcome contacts_of(const Heap& heap, const ContactParams& params, double timestep, std::size_t owned,
                    std::vector<GrainContact>* found = nullptr) {
  Outcome all{std::vector<Vec3>(heap.positions.size()), std::vector<Vec3>(heap.positions.size()), heap.slips,
              heap.touching};
  GrainContacts(params).add_forces(
      {heap.positions, heap.velocities, heap.spins, heap.bodies, owned, all.forces, all.torques},
      {heap.i, heap.j, all.touching, all.slips}, timestep, found);
  return all;
}

ContactParams params_of(ContactForm form) {
  ContactParams params;
  params.form = form;
  params.stiffness = 2000;
  params.shear_stiffness = 600;
  params.damping = 50;
  params.shear_damping = 25;
  params.friction = 0.4;
  return params;
}

double slip_error(const std::vector<Vec3>& found, const std::vector<Vec3>& expected) {
  double worst = 0;
  for (std::size_t k = 0; k < found.size(); ++k)
    worst = std::max(worst, std::sqrt(norm2(found[k] - expected[k])));
  return worst;
}

void expect_equal(const Heap& heap, const ContactParams& params, double timestep, std::size_t owned) {
  const Outcome expected = plain_contacts(heap, params, timestep, owned);
  for (const InstructionSet set : supported_sets()) {
    set_instruction_set(set);
    const Outcome found = contacts_of(heap, params, timestep, owned);
    const auto where = [&] {
      return std::string(name(set)) + ", form " + std::to_string(static_cast<int>(params.form));
    };
    EXPECT_LT(force_error(found.forces, expected.forces), 1e-12) << where();
    EXPECT_LT(force_error(found.torques, expected.torques), 1e-12) << where();
    if (params.form == ContactForm::hooke) continue;
    EXPECT_EQ(found.touching, expected.touching) << where();
    EXPECT_LT(slip_error(found.slips, expected.slips), 1e-14) << where();
  }
}

TEST(GrainContactsTest, EqualAPlainLoop) {
  const RestoreInstructionSet restore;
  for (const std::size_t pairs : {1u, 2u, 7u, 8u, 9u, 255u, 256u, 257u, 1000u})
    for (const bool some_frozen : {false, true})
      for (const ContactForm form : kForms) {
        const Heap heap = heap_of(pairs, some_frozen);
        expect_equal(heap, params_of(form), 0.002, heap.positions.size());
      }
}

TEST(GrainContactsTest, HoldAndSlideAndPull) {
  const RestoreInstructionSet restore;
  const Heap heap = heap_of(500, true);
  for (const ContactForm form : kForms)
    for (const double friction : {0.0, 0.01, 100.0})
      for (const bool limits_damping : {false, true}) {
        ContactParams params = params_of(form);
        params.friction = friction;
        params.damping = 300;
        params.limits_damping = limits_damping;
        expect_equal(heap, params, 0.002, heap.positions.size());
        params.shear_damping = 0;
        expect_equal(heap, params, 0.002, heap.positions.size());
      }
}

/// Before the first step contacts neither slip nor turn, and those that are new have no friction.
TEST(GrainContactsTest, StayBeforeTheFirstStep) {
  const RestoreInstructionSet restore;
  Heap heap = heap_of(500, false);
  for (const ContactForm form : kForms) expect_equal(heap, params_of(form), -1, heap.positions.size());
  for (Vec3& slip : heap.slips) slip = {};
  for (const ContactForm form : kForms) expect_equal(heap, params_of(form), -1, heap.positions.size());
}

TEST(GrainContactsTest, LeaveOutOthersGrains) {
  const RestoreInstructionSet restore;
  const Heap heap = heap_of(500, false);
  for (const ContactForm form : kForms) expect_equal(heap, params_of(form), 0.002, heap.positions.size() / 2);
}

/// Rest and exact touch: nothing is divided by zero.
TEST(GrainContactsTest, HaveNoForceAtRestAndNoneWhereTheyBarelyTouch) {
  const RestoreInstructionSet restore;
  Heap heap;
  heap.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0.9, 0}};
  heap.velocities = heap.spins = std::vector<Vec3>(3);
  heap.bodies = {{0.5, 1, 1}, {0.5, 1, 0}, {0.5, 1, 1}};
  heap.i = {0, 0};
  heap.j = {1, 2};
  heap.touching = {1, 0};
  heap.slips = {{0.1, 0, 0}, {}};
  for (const ContactForm form : kForms)
    for (const InstructionSet set : supported_sets()) {
      set_instruction_set(set);
      const Outcome found = contacts_of(heap, params_of(form), 0.002, 3);
      EXPECT_EQ(found.forces[1], Vec3{});
      EXPECT_EQ(found.torques, std::vector<Vec3>(3));
      EXPECT_LT(found.forces[0].y, -30);
      EXPECT_EQ(found.forces[0].y, -found.forces[2].y);
      if (form == ContactForm::hooke) continue;
      EXPECT_EQ(found.touching, (std::vector<std::int32_t>{0, 1}));
      EXPECT_EQ(found.slips, std::vector<Vec3>(2));
    }
}

TEST(GrainContactsTest, ShowWhatTouches) {
  const RestoreInstructionSet restore;
  const Heap heap = heap_of(300, false);
  for (const InstructionSet set : supported_sets()) {
    set_instruction_set(set);
    std::vector<GrainContact> found;
    const Outcome all =
        contacts_of(heap, params_of(ContactForm::hooke_history), 0.002, heap.positions.size(), &found);
    EXPECT_EQ(static_cast<std::int64_t>(found.size()),
              std::count(all.touching.begin(), all.touching.end(), 1));
    std::vector<Vec3> forces(heap.positions.size());
    for (const GrainContact& contact : found) {
      const auto i = static_cast<std::size_t>(contact.i), j = static_cast<std::size_t>(contact.j);
      forces[i] = forces[i] + contact.force;
      forces[j] = forces[j] - contact.force;
      EXPECT_EQ(contact.from_j_to_i, heap.positions[i] - heap.positions[j]);
    }
    EXPECT_LT(force_error(forces, all.forces), 1e-14) << name(set);
  }
}

TEST(GrainContactsTest, RefuseWhatDoesNotFit) {
  for (const double wrong : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    ContactParams params = params_of(ContactForm::hooke);
    params.friction = wrong;
    EXPECT_THROW(GrainContacts{params}, InvalidParameter);
  }
  Heap heap = heap_of(3, false);
  heap.velocities.pop_back();
  EXPECT_THROW(contacts_of(heap, params_of(ContactForm::hooke), 0.1, 2), InvalidParameter);
  heap = heap_of(3, false);
  heap.j.pop_back();
  EXPECT_THROW(contacts_of(heap, params_of(ContactForm::hooke), 0.1, 2), InvalidParameter);
  heap = heap_of(3, false);
  heap.slips.pop_back();
  EXPECT_THROW(contacts_of(heap, params_of(ContactForm::hooke_history), 0.1, 2), InvalidParameter);
}

}  // namespace
}  // namespace dch
