// SPDX-License-Identifier: MIT
//
// NecklaceContactForce; included by force.i, which has what both classes need.
%{
#include "NecklaceContactForce.h"

namespace {

/// A sequence, each item taken by `item(object, value)`. False with a Python error if it is none.
template <class T, class F>
bool sequence_of(PyObject* object, std::vector<T>& values, const char* what, const F& item) {
  PyObject* const items = PySequence_Fast(object, what);
  if (!items) return false;
  for (Py_ssize_t k = 0; k < PySequence_Fast_GET_SIZE(items); ++k) {
    T value = 0;
    if (!item(PySequence_Fast_GET_ITEM(items, k), value)) break;
    values.push_back(value);
  }
  Py_DECREF(items);
  return !PyErr_Occurred();
}

bool particles_of(PyObject* object, std::vector<int>& particles) {
  return sequence_of(object, particles, "particles are a sequence of indices", integer_of);
}

/// Numbers or quantities, or one quantity of all.
bool radii_of(PyObject* object, std::vector<double>& radii) {
  const Unit unit{"nanometer", 1};
  PyObject* const numbers = stripped(object, unit);
  const auto radius_of = [&](PyObject* item, double& value) { return number_of(item, value, unit); };
  const bool done = numbers && sequence_of(numbers, radii, "radii are a sequence of lengths", radius_of);
  Py_XDECREF(numbers);
  return done;
}

PyObject* python_number(int value) { return PyLong_FromLong(value); }
PyObject* python_number(double value) { return PyFloat_FromDouble(value); }

// A tuple, since SWIG would append what comes next to a list.
template <class T>
PyObject* tuple_of(const std::vector<T>& values) {
  PyObject* const tuple = PyTuple_New(static_cast<Py_ssize_t>(values.size()));
  for (std::size_t k = 0; tuple && k < values.size(); ++k)
    PyTuple_SET_ITEM(tuple, static_cast<Py_ssize_t>(k), python_number(values[k]));
  return tuple;
}

PyObject* list_of(const std::vector<OpenMMDCH::NecklaceContact>& contacts) {
  PyObject* const list = PyList_New(static_cast<Py_ssize_t>(contacts.size()));
  for (std::size_t k = 0; list && k < contacts.size(); ++k)
    PyList_SET_ITEM(list, static_cast<Py_ssize_t>(k),
                    Py_BuildValue("(iid)", contacts[k].particle1, contacts[k].particle2, contacts[k].gap));
  return list;
}

}  // namespace
%}

%typemap(in) const std::vector<int>& (std::vector<int> particles) {
  if (!particles_of($input, particles)) SWIG_fail;
  $1 = &particles;
}
%typemap(in) const std::vector<double>& (std::vector<double> radii) {
  if (!radii_of($input, radii)) SWIG_fail;
  $1 = &radii;
}
%typemap(in, numinputs=0) std::vector<int>& particles_out (std::vector<int> values) { $1 = &values; }
%typemap(in, numinputs=0) std::vector<double>& radii_out (std::vector<double> values) { $1 = &values; }
%typemap(argout) std::vector<int>& particles_out, std::vector<double>& radii_out {
  %append_output(tuple_of(*$1));
}
%typemap(in, numinputs=0) bool& closed_out (bool value = false) { $1 = &value; }
%typemap(argout) bool& closed_out { %append_output(PyBool_FromLong(*$1)); }
%typemap(out) std::vector<OpenMMDCH::NecklaceContact> {
  const std::vector<OpenMMDCH::NecklaceContact>& contacts = $1;
  $result = list_of(contacts);
}

%pythoncode %{
def _strength(value):
    if not _unit.is_quantity(value):
        return value
    for in_unit in (_unit.kilojoule_per_mole, _unit.kilojoule_per_mole / _unit.nanometer**2):
        if value.unit.is_compatible(in_unit):
            return value.value_in_unit(in_unit)
    raise TypeError(f"a strength in {value.unit} is neither an energy nor, for Harmonic, one per squared length")
%}
%pythonprepend OpenMMDCH::NecklaceContactForce::setStrength %{
        value = _strength(value)
%}
%pythonappend OpenMMDCH::NecklaceContactForce::getStrength() const %{
        val = val * (_unit.kilojoule_per_mole / _unit.nanometer**2
                     if self.getEnergyFunction() == self.Harmonic else _unit.kilojoule_per_mole)
%}
%pythonappend OpenMMDCH::NecklaceContactForce::getChainParameters %{
        val = [list(val[0]), _unit.Quantity(list(val[1]), _unit.nanometer), val[2]]
%}
%pythonappend OpenMMDCH::NecklaceContactForce::getContacts %{
        val = [(i, j, gap * _unit.nanometer) for i, j, gap in val]
%}
%feature("kwargs") OpenMMDCH::NecklaceContactForce::addChain;
%feature("kwargs") OpenMMDCH::NecklaceContactForce::setChainParameters;
%feature("kwargs") OpenMMDCH::NecklaceContactForce::getContacts;
%newobject OpenMMDCH::NecklaceContactForce::__copy__;

namespace OpenMMDCH {

class NecklaceContactForce : public OpenMM::Force {
 public:
  enum EnergyFunction { WCA = 0, Harmonic = 1, SoftCosine = 2 };

  NecklaceContactForce();

  int getNumChains() const;
  int getNumBeads() const;
  EnergyFunction getEnergyFunction() const;
  void setEnergyFunction(EnergyFunction function);
  double getStrength() const;
  void setStrength(double value);
  int getExcludedBonds() const;
  void setExcludedBonds(int bonds);
  bool getActsWithinChains() const;
  void setActsWithinChains(bool acts);
  bool getActsBetweenChains() const;
  void setActsBetweenChains(bool acts);
  void setUsesPeriodicBoundaryConditions(bool periodic);
  int addChain(const std::vector<int>& particles, const std::vector<double>& radii, bool closed = false);
  void getChainParameters(int index, std::vector<int>& particles_out, std::vector<double>& radii_out,
                          bool& closed_out) const;
  void setChainParameters(int index, const std::vector<int>& particles, const std::vector<double>& radii,
                          bool closed = false);
  void updateParametersInContext(OpenMM::Context& context);
  std::vector<OpenMMDCH::NecklaceContact> getContacts(OpenMM::Context& context, double maxGap = 0);
  std::string getSearchInContext(const OpenMM::Context& context) const;

  %extend {
    /// The force as this class: System.getForce() does not know it.
    static NecklaceContactForce& cast(OpenMM::Force& force) {
      auto* const found = dynamic_cast<OpenMMDCH::NecklaceContactForce*>(&force);
      if (!found) throw OpenMM::OpenMMException("the force " + force.getName() + " is no NecklaceContactForce");
      return *found;
    }
    static bool isinstance(OpenMM::Force& force) {
      return dynamic_cast<OpenMMDCH::NecklaceContactForce*>(&force) != nullptr;
    }
    NecklaceContactForce* __copy__() const { return new OpenMMDCH::NecklaceContactForce(*$self); }
  }
  %pythoncode %{
    def __deepcopy__(self, memo):
        return self.__copy__()

    def __setstate__(self, text):
        # What OpenMM reads is a plain Force to Python, and goes with its last reference.
        force = openmm.XmlSerializer.deserialize(text)
        self.this = NecklaceContactForce.cast(force).__copy__().this
  %}
};

}  // namespace OpenMMDCH
