// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include <dch/necklace/contacts.hpp>
#include <dch/necklace/necklace.hpp>

namespace dch::necklace::detail {

/// Which places are asked for beside a given one, as far as chains tell.
class BesidePlace {
 public:
  BesidePlace(const Necklace& necklace, const ContactQuery& query, std::int32_t place)
      : query_(query), place_(place) {
    const std::size_t chain = necklace.chain_at(place);
    first_ = necklace.first_place(chain);
    end_ = necklace.first_place(chain + 1);
    is_closed_ = necklace.chains().closed(chain);
  }
  bool asks_for(std::int32_t other) const {
    if (other < first_ || other >= end_) return query_.between_chains;
    const std::int32_t along = std::abs(place_ - other);
    const std::int32_t bonds = is_closed_ ? std::min(along, end_ - first_ - along) : along;
    return query_.within_chains && bonds > query_.skip_bonds;
  }

 private:
  const ContactQuery& query_;
  std::int32_t place_, first_, end_;
  bool is_closed_;
};

}  // namespace dch::necklace::detail
