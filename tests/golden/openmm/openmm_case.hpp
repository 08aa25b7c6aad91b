// SPDX-License-Identifier: MIT
#pragma once

#include <OpenMM.h>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "DCHNonbondedForce.h"
#include "DropIn.h"
#include "random.hpp"

namespace OpenMMDCH {

using OpenMM::Vec3;

/// N_A e^2 / (4 pi epsilon_0) from CODATA's constants of 2018 [kJ nm/mol/e^2].
inline constexpr double kCoulomb =
    6.02214076e23 * 1.602176634e-19 * 1.602176634e-19 / (4 * M_PI * 8.8541878128e-12) * 1e9 / 1e3;

/// The platforms that offer the force; loads OpenMM's plugins and ours.
inline std::vector<std::string> dch_platforms() {
  static const bool loaded = [] {
    OpenMM::Platform::loadPluginsFromDirectory(OpenMM::Platform::getDefaultPluginsDirectory());
    OpenMM::Platform::loadPluginsFromDirectory(DCH_OPENMM_PLUGINS);
    return true;
  }();
  (void)loaded;
  return {"Reference", "CPU"};
}

/// What stands before the name of a platform where OpenMM's own force is computed by the drop-in.
inline const std::string kDropIn = "DropIn";

inline bool is_drop_in(const std::string& way) { return way.compare(0, kDropIn.size(), kDropIn) == 0; }
inline std::string platform_of(const std::string& way) {
  return is_drop_in(way) ? way.substr(kDropIn.size()) : way;
}

/// The ways to have a nonbonded force computed: by our force on each platform, and by the drop-in.
inline std::vector<std::string> dch_ways() {
  std::vector<std::string> ways = dch_platforms();
  for (const std::string& platform : dch_platforms()) ways.push_back(kDropIn + platform);
  return ways;
}

/// How far forces and energies may be from exact ones: in single precision as OpenMM's own tests have it.
inline double tolerance_of(const std::string& way) { return platform_of(way) == "Reference" ? 1e-10 : 1e-5; }

struct Evaluation {
  double energy = 0;
  std::vector<Vec3> forces;
  double size = 0;  ///< sum of the absolute energies of all terms, where an oracle has added them
};

/// A System of particles, with room for bonds and forces.
struct Case {
  OpenMM::System system;
  std::vector<Vec3> positions;
  DCHNonbondedForce* force = new DCHNonbondedForce();  // owned by the System

  Case() { system.addForce(force); }
  void add(double charge, double sigma, double epsilon, Vec3 at) {
    system.addParticle(1.0);
    force->addParticle(charge, sigma, epsilon);
    positions.push_back(at);
  }
  void set_box(Vec3 a, Vec3 b, Vec3 c) { system.setDefaultPeriodicBoxVectors(a, b, c); }
  void set_method(DCHNonbondedForce::NonbondedMethod method, double cutoff) {
    force->setNonbondedMethod(method);
    force->setCutoffDistance(cutoff);
  }
};

/// Enables the drop-in for as long as it lives.
class DropInEnabled {
 public:
  explicit DropInEnabled(bool wanted = true) : wanted_(wanted) {
    if (wanted_) enableDropIn();
  }
  ~DropInEnabled() {
    if (wanted_) disableDropIn();
  }
  DropInEnabled(const DropInEnabled&) = delete;
  DropInEnabled& operator=(const DropInEnabled&) = delete;

 private:
  bool wanted_;
};

/// A copy of a System with OpenMM's own force in the place of each of ours, behind the others.
inline std::unique_ptr<OpenMM::System> with_native_forces(const OpenMM::System& system) {
  std::unique_ptr<OpenMM::System> copy(OpenMM::XmlSerializer::clone(system));
  for (int k = copy->getNumForces() - 1; k >= 0; --k) {
    const auto* const own = dynamic_cast<const DCHNonbondedForce*>(&copy->getForce(k));
    if (!own) continue;
    auto* const native = new OpenMM::NonbondedForce(own->getParameters());
    native->setForceGroup(own->getForceGroup());
    copy->removeForce(k);
    copy->addForce(native);
  }
  return copy;
}

/// A Context that lives with its integrator, and with its System where that is a copy for the drop-in.
class Host {
 public:
  Host(const OpenMM::System& system, const std::string& way,
       const std::map<std::string, std::string>& properties = {})
      : integrator_(0.001) {
    const DropInEnabled enabled(is_drop_in(way));
    if (is_drop_in(way)) own_ = with_native_forces(system);
    context_ =
        std::make_unique<OpenMM::Context>(own_ ? *own_ : system, integrator_,
                                          OpenMM::Platform::getPlatformByName(platform_of(way)), properties);
  }
  OpenMM::Context& operator*() { return *context_; }
  OpenMM::Context* operator->() { return context_.get(); }
  Evaluation evaluate(int groups = 0xFFFFFFFF) {
    const OpenMM::State state =
        context_->getState(OpenMM::State::Forces | OpenMM::State::Energy, false, groups);
    return {state.getPotentialEnergy(), state.getForces()};
  }
  Evaluation evaluate(const std::vector<Vec3>& positions) {
    context_->setPositions(positions);
    return evaluate();
  }

 private:
  std::unique_ptr<OpenMM::System> own_;
  OpenMM::VerletIntegrator integrator_;
  std::unique_ptr<OpenMM::Context> context_;
};

inline Evaluation evaluate(const Case& of, const std::string& platform) {
  return Host(of.system, platform).evaluate(of.positions);
}

/// As OpenMM's ASSERT_EQUAL_TOL: relative to what is expected, or absolute if that is below 1.
inline void expect_near(double expected, double found, double tolerance, const std::string& what) {
  EXPECT_NEAR(found, expected, tolerance * std::max(1.0, std::abs(expected))) << what;
}

inline void expect_near(const Vec3& expected, const Vec3& found, double tolerance, const std::string& what) {
  const double size = std::max(1.0, std::sqrt(expected.dot(expected)));
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(found[axis], expected[axis], tolerance * size) << what << ", axis " << axis;
}

inline void expect_near(const Evaluation& expected, const Evaluation& found, double tolerance,
                        const std::string& what = "") {
  expect_near(expected.energy, found.energy, tolerance, what + " energy");
  ASSERT_EQ(found.forces.size(), expected.forces.size());
  for (std::size_t i = 0; i < found.forces.size(); ++i)
    expect_near(expected.forces[i], found.forces[i], tolerance, what + " force " + std::to_string(i));
}

/// Runs f and hands over what it throws, "" if nothing.
template <class F>
std::string message_of(const F& f) {
  try {
    f();
  } catch (const OpenMM::OpenMMException& e) {
    return e.what();
  }
  return {};
}

class OnPlatform : public testing::TestWithParam<std::string> {
 protected:
  double tolerance() const { return tolerance_of(GetParam()); }
};

inline std::string name_of_platform(const testing::TestParamInfo<std::string>& platform) {
  return platform.param;
}

/// Tests of a suite derived from OnPlatform run once on each platform.
#define DCH_ON_EACH_PLATFORM(Suite) \
  INSTANTIATE_TEST_SUITE_P(Platforms, Suite, testing::ValuesIn(dch_platforms()), name_of_platform)
/// The same, by the drop-in too.
#define DCH_IN_EACH_WAY(Suite) \
  INSTANTIATE_TEST_SUITE_P(Platforms, Suite, testing::ValuesIn(dch_ways()), name_of_platform)

}  // namespace OpenMMDCH
