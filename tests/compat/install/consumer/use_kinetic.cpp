// SPDX-License-Identifier: MIT
#include <cstdio>
#include <vector>

#include <dch/kinetic/kinetic_edges.hpp>

int main() {
  dch::kinetic::KineticParams params;
  params.cutoff = 1;
  const std::vector<dch::kinetic::FlightPlan> plans{{0, {-3, 0, 0}, {1, 0, 0}, {}}, {}};
  const auto edges = dch::kinetic::make_kinetic_edges(params, plans, 0);
  const auto event = edges->step(10);
  std::printf("they meet at %g\n", event ? event->time : -1);
  return event && event->time == 2 ? 0 : 1;
}
