// SPDX-License-Identifier: MIT
%module(package="openmm_dch") force

%import(module="openmm") "OpenMMMinimal.i"
%include "std_string.i"
%include "typemaps.i"

%{
#include <OpenMM.h>
#include <string>
#include <utility>
#include <vector>

#include "DCHNonbondedForce.h"

namespace {

/// What a quantity may be given in: a unit of OpenMM's unit module to a power, or, without a name, any one of OpenMM's
/// unit system.
struct Unit {
  const char* name = nullptr;
  long power = 1;
};

PyObject* unit_module_attribute(const char* name) {
  PyObject* const units = PyImport_ImportModule("openmm.unit");
  PyObject* const attribute = units ? PyObject_GetAttrString(units, name) : nullptr;
  Py_XDECREF(units);
  return attribute;
}

/// The value of a quantity: a new reference, null with a Python error if its unit is another one.
PyObject* value_in(PyObject* quantity, Unit unit) {
  PyObject* in = unit_module_attribute(unit.name ? unit.name : "md_unit_system");
  if (in && unit.power != 1) {
    PyObject* const power = PyLong_FromLong(unit.power);
    PyObject* const raised = PyNumber_Power(in, power, Py_None);
    Py_XDECREF(power);
    Py_DECREF(in);
    in = raised;
  }
  PyObject* const value =
      in ? PyObject_CallMethod(quantity, unit.name ? "value_in_unit" : "value_in_unit_system", "O", in) : nullptr;
  Py_XDECREF(in);
  return value;
}

/// The object, or its value if it is a quantity: a new reference, null with a Python error.
PyObject* stripped(PyObject* object, Unit unit) {
  if (PyObject_HasAttrString(object, "value_in_unit_system")) return value_in(object, unit);
  Py_INCREF(object);
  return object;
}

/// A number, or a quantity. False with a Python error if it is neither, or one in another unit.
bool number_of(PyObject* object, double& value, Unit unit = {}) {
  PyObject* const number = stripped(object, unit);
  if (number) value = PyFloat_AsDouble(number);
  Py_XDECREF(number);
  return !PyErr_Occurred();
}

/// An integer of Python or numpy. False with a Python error if it is none.
bool integer_of(PyObject* object, int& value) {
  PyObject* const index = PyNumber_Index(object);
  const long number = index ? PyLong_AsLong(index) : 0;
  Py_XDECREF(index);
  value = static_cast<int>(number);
  if (!PyErr_Occurred() && value != number) PyErr_SetString(PyExc_OverflowError, "an integer is too large");
  return !PyErr_Occurred();
}

/// A sequence of pairs of particles. False with a Python error if it is none.
bool bonds_of(PyObject* object, std::vector<std::pair<int, int> >& bonds) {
  PyObject* const items = PySequence_Fast(object, "bonds are pairs of particle indices");
  if (!items) return false;
  for (Py_ssize_t k = 0; k < PySequence_Fast_GET_SIZE(items) && !PyErr_Occurred(); ++k) {
    PyObject* const bond = PySequence_Tuple(PySequence_Fast_GET_ITEM(items, k));
    PyObject *i = nullptr, *j = nullptr;
    std::pair<int, int> of;
    if (bond && PyArg_ParseTuple(bond, "OO;a bond is a pair of particle indices", &i, &j) && integer_of(i, of.first) &&
        integer_of(j, of.second))
      bonds.push_back(of);
    Py_XDECREF(bond);
  }
  Py_DECREF(items);
  return !PyErr_Occurred();
}

void raise(const char* message) {
  PyObject* const openmm = PyImport_ImportModule("openmm");
  PyObject* const type = openmm ? PyObject_GetAttrString(openmm, "OpenMMException") : nullptr;
  if (type) PyErr_SetString(type, message);
  Py_XDECREF(type);
  Py_XDECREF(openmm);
}

}  // namespace
%}

%exception {
  try {
    $action
  } catch (const std::exception& e) {
    raise(e.what());
    SWIG_fail;
  }
}

%typemap(in) double {
  if (!number_of($input, $1)) SWIG_fail;
}
%define TAKES(names, unit, power)
%typemap(in) names {
  if (!number_of($input, $1, {unit, power})) SWIG_fail;
}
%enddef
TAKES(double charge, "elementary_charge", 1)
TAKES(double chargeProd, "elementary_charge", 2)
TAKES(double sigma, "nanometer", 1)
TAKES(double distance, "nanometer", 1)
TAKES(double maxGap, "nanometer", 1)
TAKES(double epsilon, "kilojoule_per_mole", 1)
TAKES(double dielectric, "dimensionless", 1)
TAKES(double coulomb14Scale, "dimensionless", 1)
TAKES(double lj14Scale, "dimensionless", 1)
%typemap(in) int {
  if (!integer_of($input, $1)) SWIG_fail;
}
%typemap(in) enum SWIGTYPE (int number) {
  if (!integer_of($input, number)) SWIG_fail;
  $1 = static_cast<$1_ltype>(number);
}
%typemap(in) const std::vector<std::pair<int, int> >& (std::vector<std::pair<int, int> > bonds) {
  if (!bonds_of($input, bonds)) SWIG_fail;
  $1 = &bonds;
}
%typemap(in, numinputs=0) std::string& parameter_out (std::string text) { $1 = &text; }
%typemap(argout) std::string& parameter_out {
  %append_output(PyUnicode_FromString($1->c_str()));
}
%apply std::string& parameter_out { std::string& parameter };
%apply double& OUTPUT {
  double& charge, double& sigma, double& epsilon, double& chargeProd, double& chargeScale, double& sigmaScale,
  double& epsilonScale, double& chargeProdScale
};
%apply int& OUTPUT { int& particle1, int& particle2, int& particleIndex, int& exceptionIndex };

%pythoncode %{
from openmm import unit as _unit

_PARAMETER_UNITS = (_unit.elementary_charge, _unit.nanometer, _unit.kilojoule_per_mole)
_EXCEPTION_UNITS = (_unit.elementary_charge**2, _unit.nanometer, _unit.kilojoule_per_mole)


def _with_units(values, units):
    """Gives the last values units, as OpenMM's own classes do."""
    first = len(values) - len(units)
    return list(values[:first]) + [value * u for value, u in zip(values[first:], units)]
%}

%define IN_NANOMETERS(method)
%pythonappend OpenMMDCH::DCHNonbondedForce::method() const %{ val = val * _unit.nanometer %}
%enddef
%define WITH_UNITS(method, units)
%pythonappend OpenMMDCH::DCHNonbondedForce::method %{ val = _with_units(val, units) %}
%enddef
IN_NANOMETERS(getCutoffDistance)
IN_NANOMETERS(getSwitchingDistance)
WITH_UNITS(getParticleParameters, _PARAMETER_UNITS)
WITH_UNITS(getParticleParameterOffset, _PARAMETER_UNITS)
WITH_UNITS(getExceptionParameters, _EXCEPTION_UNITS)
WITH_UNITS(getExceptionParameterOffset, _EXCEPTION_UNITS)

%feature("autodoc", "1");
// One function, whose arguments are converted, not two that are chosen between by what arguments are.
%feature("kwargs") OpenMMDCH::DCHNonbondedForce::addException;
%newobject OpenMMDCH::DCHNonbondedForce::fromNonbonded;
%newobject OpenMMDCH::DCHNonbondedForce::__copy__;

namespace OpenMMDCH {

class DCHNonbondedForce : public OpenMM::Force {
 public:
  enum NonbondedMethod { NoCutoff = 0, CutoffNonPeriodic = 1, CutoffPeriodic = 2 };

  DCHNonbondedForce();
  static DCHNonbondedForce* fromNonbonded(const OpenMM::NonbondedForce& force);

  int getNumParticles() const;
  int getNumExceptions() const;
  int getNumGlobalParameters() const;
  int getNumParticleParameterOffsets() const;
  int getNumExceptionParameterOffsets() const;
  NonbondedMethod getNonbondedMethod() const;
  void setNonbondedMethod(NonbondedMethod method);
  double getCutoffDistance() const;
  void setCutoffDistance(double distance);
  bool getUseSwitchingFunction() const;
  void setUseSwitchingFunction(bool use);
  double getSwitchingDistance() const;
  void setSwitchingDistance(double distance);
  double getReactionFieldDielectric() const;
  void setReactionFieldDielectric(double dielectric);
  int addParticle(double charge, double sigma, double epsilon);
  void getParticleParameters(int index, double& charge, double& sigma, double& epsilon) const;
  void setParticleParameters(int index, double charge, double sigma, double epsilon);
  int addException(int particle1, int particle2, double chargeProd, double sigma, double epsilon,
                   bool replace = false);
  void getExceptionParameters(int index, int& particle1, int& particle2, double& chargeProd, double& sigma,
                              double& epsilon) const;
  void setExceptionParameters(int index, int particle1, int particle2, double chargeProd, double sigma,
                              double epsilon);
  void createExceptionsFromBonds(const std::vector<std::pair<int, int> >& bonds, double coulomb14Scale,
                                 double lj14Scale);
  int addGlobalParameter(const std::string& parameter, double defaultValue);
  const std::string& getGlobalParameterName(int index) const;
  void setGlobalParameterName(int index, const std::string& parameter);
  double getGlobalParameterDefaultValue(int index) const;
  void setGlobalParameterDefaultValue(int index, double defaultValue);
  int addParticleParameterOffset(const std::string& parameter, int particleIndex, double chargeScale,
                                 double sigmaScale, double epsilonScale);
  void getParticleParameterOffset(int index, std::string& parameter, int& particleIndex, double& chargeScale,
                                  double& sigmaScale, double& epsilonScale) const;
  void setParticleParameterOffset(int index, const std::string& parameter, int particleIndex,
                                  double chargeScale, double sigmaScale, double epsilonScale);
  int addExceptionParameterOffset(const std::string& parameter, int exceptionIndex, double chargeProdScale,
                                  double sigmaScale, double epsilonScale);
  void getExceptionParameterOffset(int index, std::string& parameter, int& exceptionIndex,
                                   double& chargeProdScale, double& sigmaScale, double& epsilonScale) const;
  void setExceptionParameterOffset(int index, const std::string& parameter, int exceptionIndex,
                                   double chargeProdScale, double sigmaScale, double epsilonScale);
  bool getUseDispersionCorrection() const;
  void setUseDispersionCorrection(bool useCorrection);
  bool getExceptionsUsePeriodicBoundaryConditions() const;
  void setExceptionsUsePeriodicBoundaryConditions(bool periodic);
  void updateParametersInContext(OpenMM::Context& context);

  %extend {
    /// The force as this class: System.getForce() does not know it.
    static DCHNonbondedForce& cast(OpenMM::Force& force) {
      auto* const found = dynamic_cast<OpenMMDCH::DCHNonbondedForce*>(&force);
      if (!found) throw OpenMM::OpenMMException("the force " + force.getName() + " is no DCHNonbondedForce");
      return *found;
    }
    static bool isinstance(OpenMM::Force& force) {
      return dynamic_cast<OpenMMDCH::DCHNonbondedForce*>(&force) != nullptr;
    }
    DCHNonbondedForce* __copy__() const { return new OpenMMDCH::DCHNonbondedForce(*$self); }
  }
  %pythoncode %{
    def __deepcopy__(self, memo):
        return self.__copy__()

    def __setstate__(self, text):
        # What OpenMM reads is a plain Force to Python, and goes with its last reference.
        force = openmm.XmlSerializer.deserialize(text)
        self.this = DCHNonbondedForce.cast(force).__copy__().this
  %}
};

}  // namespace OpenMMDCH

%include "contacts.i"
%include "drop_in.i"
