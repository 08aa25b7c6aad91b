// SPDX-License-Identifier: MIT
//
// The drop-in; included by force.i. openmm_dch/_drop_in.py makes its functions of these.
%{
#include "DropIn.h"

namespace {

PyObject* list_of(const std::vector<OpenMMDCH::NonbondedStatus>& all) {
  PyObject* const list = PyList_New(static_cast<Py_ssize_t>(all.size()));
  for (std::size_t k = 0; list && k < all.size(); ++k) {
    const OpenMMDCH::NonbondedStatus& s = all[k];
    PyList_SET_ITEM(list, static_cast<Py_ssize_t>(k),
                    Py_BuildValue("{s:i,s:s,s:s,s:s,s:s}", "force", s.force, "name", s.name.c_str(), "direct",
                                  s.direct.c_str(), "reciprocal", s.reciprocal.c_str(), "reason", s.reason.c_str()));
  }
  return list;
}

}  // namespace
%}

%typemap(out) std::vector<OpenMMDCH::NonbondedStatus> {
  const std::vector<OpenMMDCH::NonbondedStatus>& all = $1;
  $result = list_of(all);
}

namespace OpenMMDCH {
enum class DropInPrecision { Mixed, Double };
void enableDropIn(DropInPrecision precision);
void disableDropIn();
bool isDropInEnabled();
bool enableReciprocal();
int countOfForcesBeforeDropIn();
std::vector<OpenMMDCH::NonbondedStatus> nonbondedStatus(const OpenMM::Context& context);
}  // namespace OpenMMDCH
