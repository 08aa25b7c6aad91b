// SPDX-License-Identifier: GPL-2.0-or-later
#include "dch_command.h"

#include <comm.h>
#include <error.h>
#include <string>
#include <vector>

#include <dch/base/error.hpp>

#include "chosen_styles.h"
#include "dch_options.h"
#include "neighbor_dch.h"
#include "style_notes.h"
#include "styles.h"

namespace LAMMPS_NS {
void DchCommand::command(int narg, char** arg) {
  using dch::lammps::Request;
  Request request;
  try {
    request = dch::lammps::parse_request(std::vector<std::string>(arg, arg + narg));
  } catch (const dch::InvalidParameter& e) {
    error->all(FLERR, std::string(e.what()));
  }
  register_styles_dch(*lmp);  // again after `clear`, which forgets them
  NeighborDCH* neighbor_dch = NeighborDCH::install(lmp);
  switch (request.action) {
    case Request::Action::on:
      if (request.has_c && comm->me == 0)
        error->warning(
            FLERR,
            std::string(
                "'dch on c' has no effect any more and will be an error in the next version; give 'dch on'"));
      neighbor_dch->enable(request.engine);
      break;
    case Request::Action::styles:
      neighbor_dch->set_styles(request.takes_styles);
      break;
    case Request::Action::off:
      neighbor_dch->disable();
      break;
    case Request::Action::verify:
      neighbor_dch->set_verify(request.verify_every);
      break;
    case Request::Action::precision:
      neighbor_dch->set_precision(request.precision);
      break;
    case Request::Action::skin:
      neighbor_dch->set_skin_tuning(request.tunes_skin);
      break;
    case Request::Action::order:
      neighbor_dch->set_order(request.order_atoms);
      break;
    case Request::Action::expiry:
      neighbor_dch->set_expiry(request.expiry);
      break;
    case Request::Action::threads:
      neighbor_dch->set_threads(request.threads);
      break;
    case Request::Action::explain: {
      dch::lammps::RunReport report = neighbor_dch->report();
      report.styles = style_notes(*lmp);
      if (comm->me == 0) utils::logmesg(lmp, dch::lammps::format_explanation(report));
      break;
    }
    case Request::Action::stats: {
      const dch::lammps::RunReport report = neighbor_dch->report();
      if (comm->me == 0) utils::logmesg(lmp, dch::lammps::format_report(report));
      break;
    }
  }
  choose_styles(*lmp, neighbor_dch->takes_styles());
}

}  // namespace LAMMPS_NS
