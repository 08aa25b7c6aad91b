// SPDX-License-Identifier: MIT
#include "files/unfinished_files.hpp"

#include <array>
#include <atomic>
#include <climits>
#include <unistd.h>

#include <dch/trajectory/output_file.hpp>

namespace dch::trajectory {
namespace {

/// Who owns a place: nobody, the thread that fills it, the file whose path it holds, or for good the signal
/// handler that removes that file.
enum class Owner : int { nobody, writer, file, handler };

struct Place {
  std::atomic<Owner> owner{Owner::nobody};
  std::array<char, PATH_MAX> path;
};
static_assert(std::atomic<Owner>::is_always_lock_free, "a signal handler must not wait for a lock");

/// Memory of a fixed size and no locks, since a signal handler reads it at any moment.
std::array<Place, 64> places;

bool take(Place& place, Owner from, Owner to) {
  return place.owner.compare_exchange_strong(from, to, std::memory_order_acq_rel);
}

}  // namespace

int note_unfinished_file(const std::string& path) noexcept {
  if (path.size() >= PATH_MAX) return -1;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (!take(places[k], Owner::nobody, Owner::writer)) continue;
    path.copy(places[k].path.data(), path.size());
    places[k].path[path.size()] = '\0';
    places[k].owner.store(Owner::file, std::memory_order_release);
    return static_cast<int>(k);
  }
  return -1;
}

void forget_unfinished_file(int place) noexcept {
  if (place >= 0) take(places[static_cast<std::size_t>(place)], Owner::file, Owner::nobody);
}

void remove_unfinished_files() noexcept {
  for (Place& place : places) {
    if (take(place, Owner::file, Owner::handler)) ::unlink(place.path.data());
  }
}

}  // namespace dch::trajectory
