// SPDX-License-Identifier: MIT
#include "analysis/sphere_run.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>

#include <dch/kinetic/sphere_growth.hpp>
#include <dch/trajectory/file_error.hpp>
#include <dch/trajectory/writer.hpp>

#include "base/exit_code.hpp"
#include "base/number_text.hpp"
#include "base/stopwatch.hpp"
#include "report/output_file.hpp"

namespace dch::cli {
namespace {

using kinetic::HardSpheres;

/// A run is measured in so many parts, of which the first half lets the spheres forget their start.
constexpr int kBlocks = 20;
/// The progress bar is told after so many collisions.
constexpr std::int64_t kReport = 4096;
constexpr double kMaxFrames = 1e9;
constexpr double kMaxEdges = 1e12;       ///< of the box that a sphere may fly
constexpr double kMaxLonelyEdges = 1e6;  ///< the same without any collision, in a run that waits for them

/// Over that of an ideal gas, by the equation of state of T. Boublik, J. Chem. Phys. 53:471, 1970, and G. A.
/// Mansoori, N. F. Carnahan, K. E. Starling and T. W. Leland, J. Chem. Phys. 54:1523, 1971; for equal spheres
/// that of N. F. Carnahan and K. E. Starling, J. Chem. Phys. 51:635, 1969.
double pressure_of_state(const HardSpheres& spheres) {
  const auto count = static_cast<double>(spheres.size());
  double one = 0, two = 0, three = 0;
  for (std::int32_t id = 0; id < static_cast<std::int32_t>(spheres.size()); ++id) {
    const double diameter = 2 * spheres.radius(id);
    one += diameter / count;
    two += diameter * diameter / count;
    three += diameter * diameter * diameter / count;
  }
  const double y = spheres.volume() / spheres.box().volume(), c = y / three, open = 1 - y;
  return 1 / open + 3 * c * one * two / (open * open) +
         (3 - y) * c * c * two * two * two / (open * open * open);
}

/// By diameter, ascending, from 1.
std::vector<std::int32_t> types_of(const std::vector<double>& radii) {
  std::vector<double> known = radii;
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  std::vector<std::int32_t> types;
  types.reserve(radii.size());
  for (const double radius : radii)
    types.push_back(
        static_cast<std::int32_t>(std::lower_bound(known.begin(), known.end(), radius) - known.begin()) + 1);
  return types;
}

class SphereRun {
 public:
  SphereRun(const SphereOptions& options, ProgressBar& progress) : options_(options), progress_(progress) {}
  SphereReport run();

 private:
  void make_spheres();
  void require_relative_motion() const;
  void require_flights_that_end() const;
  void require_frames_apart() const;
  double longest_wait() const;
  void jam();
  void run_block(int block);
  void advance(double limit, std::int64_t& most);
  void write_frame();
  SphereState state() const;
  void describe_start();

  const SphereOptions& options_;
  ProgressBar& progress_;
  SphereReport report_;
  SphereState start_;
  std::unique_ptr<HardSpheres> spheres_;
  std::unique_ptr<trajectory::TrajectoryWriter> writer_;
  std::vector<std::int32_t> types_;
  double longest_wait_ = 0, last_collision_ = 0;  ///< in a run by collisions
};

/// Files are opened before any work is done, so that those that cannot be are found out.
SphereReport SphereRun::run() {
  const auto restart = open_output(options_.restart);
  if (!options_.frames.empty()) writer_ = trajectory::create_trajectory(options_.frames, "reduced");
  make_spheres();
  if (options_.jam) jam();
  report_.begin = spheres_->now();
  report_.energy_at_start = spheres_->energy();
  if (writer_) require_frames_apart();
  if (writer_) write_frame();
  progress_.start("colliding", options_.time > 0 ? 0 : options_.collisions);
  const bool runs = options_.time > 0 || options_.collisions > 0;
  last_collision_ = report_.begin;
  longest_wait_ = longest_wait();
  for (int block = 0; block < kBlocks && runs; ++block) run_block(block);
  progress_.clear();
  report_.end = spheres_->now();
  report_.fraction = spheres_->volume() / spheres_->box().volume();
  report_.expected_pressure = report_.spheres > 0 ? pressure_of_state(*spheres_) : 1;
  spheres_->synchronize();
  report_.least_gap = spheres_->least_gap();
  if (restart) restart->write(render_state(state()));
  if (writer_) writer_->close();
  if (restart) restart->commit();
  return report_;
}

void SphereRun::make_spheres() try {
  if (options_.from.empty()) {
    StartResult start = make_start(options_.start);
    start_ = std::move(start.state);
    report_.from = options_.start.start == SphereStart::lattice ? "lattice" : "random";
    report_.start_fraction = start.fraction;
    report_.growth_collisions = start.collisions;
  } else {
    start_ = read_state(options_.from);
    report_.from = options_.from;
  }
  describe_start();
  spheres_ = std::make_unique<HardSpheres>(
      kinetic::HardSphereParams{start_.box(), start_.radii, start_.masses, options_.restitution},
      start_.positions, start_.velocities, start_.time);
  if (!options_.from.empty()) report_.start_fraction = spheres_->volume() / spheres_->box().volume();
  if (options_.collisions > 0) require_relative_motion();
  require_flights_that_end();
} catch (const UsageError&) {
  throw;
} catch (const trajectory::FileError&) {
  throw;
} catch (const Error& error) {
  if (options_.from.empty()) throw;
  throw trajectory::FileError(fmt::format("{}: {}", options_.from, error.what()));
}

/// A run that ends by collisions has some.
void SphereRun::require_relative_motion() const {
  const auto moves_as_first = [&](Vec3 v) { return norm2(v - start_.velocities[0]) == 0; };
  if (!std::all_of(start_.velocities.begin(), start_.velocities.end(), moves_as_first)) return;
  throw UsageError(
      fmt::format("--collisions {}: of {} none moves relative to another, so that they never collide; say by "
                  "--time how long to run",
                  options_.collisions, counted(report_.spheres, "sphere")));
}

/// A run takes work for each stretch of a flight, so that one beyond all measure does not end.
void SphereRun::require_flights_that_end() const {
  double fastest2 = 0;
  for (const Vec3 v : start_.velocities) fastest2 = std::max(fastest2, norm2(v));
  const double duration = options_.time + (options_.jam ? 1 / options_.start.growth : 0);
  const double edges = std::sqrt(fastest2) * duration / start_.edge;
  if (edges <= kMaxEdges) return;
  throw UsageError(
      fmt::format("--time {}, --growth {}: the fastest sphere flies {:.3g} edges of the box until then, more "
                  "than {}; choose a shorter time, a faster growth or slower spheres",
                  options_.time, options_.start.growth, edges, kMaxEdges));
}

/// Times of frames differ, and they come to an end.
void SphereRun::require_frames_apart() const {
  if (report_.begin + options_.every == report_.begin)
    throw UsageError(fmt::format("--every {}: is lost in the rounding of the time {}; choose a longer one",
                                 options_.every, report_.begin));
  if (options_.time / options_.every > kMaxFrames)
    throw UsageError(fmt::format("--every {}: more than {} frames in --time {}; choose a longer one",
                                 options_.every, kMaxFrames, options_.time));
}

void SphereRun::describe_start() {
  report_.spheres = static_cast<std::int64_t>(start_.radii.size());
  report_.edge = start_.edge;
  report_.restitution = options_.restitution;
  types_ = types_of(start_.radii);
  if (start_.radii.empty()) return;
  const auto [least, most] = std::minmax_element(start_.radii.begin(), start_.radii.end());
  report_.smallest_diameter = 2 * *least;
  report_.largest_diameter = 2 * *most;
}

void SphereRun::jam() {
  const double rate = options_.start.growth;
  const kinetic::GrowthResult grown = kinetic::grow(*spheres_, {rate, 1, *options_.jam});
  report_.jam = SphereJam{rate, grown.fraction, grown.pressure, grown.is_jammed};
  if (report_.spheres == 0) return;
  report_.smallest_diameter *= spheres_->radius(0) / start_.radii[0];
  report_.largest_diameter *= spheres_->radius(0) / start_.radii[0];
}

void SphereRun::run_block(int block) {
  const Stopwatch watch;
  const double begin = spheres_->now(), virial = spheres_->virial(), energy = spheres_->energy();
  const std::int64_t before = spheres_->counters().collisions;
  const bool by_time = options_.time > 0;
  const double end = by_time ? report_.begin + options_.time * (block + 1) / kBlocks : kinetic::kMaxMagnitude;
  std::int64_t rest = std::numeric_limits<std::int64_t>::max();
  if (!by_time) rest = options_.collisions * (block + 1) / kBlocks - report_.collisions();
  while (rest > 0 && spheres_->now() < end) {
    const double frame = report_.begin + options_.every * static_cast<double>(report_.frames);
    const double stop = writer_ ? std::min(end, frame) : end;
    advance(stop, rest);
    if (writer_ && spheres_->now() >= frame) write_frame();
  }
  SphereBlock done{spheres_->now(), spheres_->counters().collisions - before, 1, spheres_->energy(),
                   watch.seconds()};
  const double passed = done.time - begin, mean = 0.5 * (energy + done.energy);
  if (passed > 0 && mean > 0) done.pressure = 1 + (spheres_->virial() - virial) / (2 * mean * passed);
  report_.blocks.push_back(done);
}

/// For a collision, in a run by these: by a speed that elastic collisions keep. Others slow down without end.
double SphereRun::longest_wait() const {
  if (options_.time > 0 || options_.restitution < 1) return std::numeric_limits<double>::infinity();
  double mass = 0;
  for (std::size_t k = 0; k < spheres_->size(); ++k) mass += spheres_->mass(static_cast<std::int32_t>(k));
  return kMaxLonelyEdges * start_.edge / std::sqrt(2 * spheres_->energy() / mass);
}

/// Up to a time or to so many collisions, which have to come.
void SphereRun::advance(double limit, std::int64_t& most) {
  for (; most > 0; --most) {
    const double last_call = last_collision_ + longest_wait_;
    if (!spheres_->step(std::min(limit, last_call))) {
      if (last_call >= limit) return;
      throw UsageError(
          fmt::format("--collisions {}: after {} nothing collides while a sphere flies {} edges of the box; "
                      "say by --time how long to run",
                      options_.collisions, report_.collisions(), kMaxLonelyEdges));
    }
    last_collision_ = spheres_->now();
    const std::int64_t done = spheres_->counters().collisions;
    if (done % kReport == 0) progress_.advance(done);
  }
}

void SphereRun::write_frame() {
  trajectory::Frame frame;
  frame.step = spheres_->counters().collisions;
  frame.time = spheres_->now();
  frame.box = spheres_->box();
  for (std::size_t k = 0; k < spheres_->size(); ++k) {
    frame.positions.push_back(spheres_->position(static_cast<std::int32_t>(k)));
    frame.ids.push_back(static_cast<std::int64_t>(k) + 1);
  }
  frame.types = types_;
  writer_->write(frame);
  ++report_.frames;
}

SphereState SphereRun::state() const {
  SphereState state;
  state.time = spheres_->now();
  state.edge = start_.edge;
  state.masses = start_.masses;
  for (std::size_t k = 0; k < spheres_->size(); ++k) {
    const auto id = static_cast<std::int32_t>(k);
    state.radii.push_back(spheres_->radius(id));
    state.positions.push_back(spheres_->position(id));
    state.velocities.push_back(spheres_->velocity(id));
  }
  return state;
}

}  // namespace

SphereReport run_hard_spheres(const SphereOptions& options, ProgressBar& progress) {
  return SphereRun(options, progress).run();
}

}  // namespace dch::cli
