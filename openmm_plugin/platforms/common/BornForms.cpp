// SPDX-License-Identifier: MIT
//
// The expressions are those of openmm/app/internal/customgbforces.py, OpenMM 7.7.
#include "BornForms.h"

#include <cmath>
#include <cstdlib>
#include <openmm/OpenMMException.h>
#include <openmm/TabulatedFunction.h>
#include <openmm/reference/SimTKOpenMMRealType.h>
#include <optional>
#include <string>

namespace OpenMMDCH {
namespace {

using OpenMM::CustomGBForce;
using OpenMM::GBSAOBCForce;

constexpr double kOffset = 0.009;  // of radii in all forms but GBn2 [nm]
constexpr double kCustomConstant = 138.935485, kCustomSurface = 28.3919551;
constexpr double kNeckReach = 0.68;  // between surfaces [nm]

const std::string kVanDerWaals =
    "select(step(r+sr2-or1), 0.5*(1/L-1/U+0.25*(r-sr2^2/r)*(1/(U^2)-1/(L^2))+0.5*log(L/U)/r), 0);"
    "U=r+sr2;L=max(or1, D);D=abs(r-sr2)";

/// One of the forms.
struct Form {
  std::string integral, radius;  ///< expressions of I and B
  double offset = kOffset;
  bool hct = false, ownCoefficients = false;  ///< of tanh: those of particles
  double alpha = 0, beta = 0, gamma = 0;
  double neckScale = 0;  ///< 0 without necks
};

std::string integralWithNecks(const std::string& scale, const std::string& offset) {
  return "Ivdw+neckScale*Ineck;"
         "Ineck=step(radius1+radius2+neckCut-r)*getm0(radindex1,radindex2)/"
         "(1+100*(r-getd0(radindex1,radindex2))^2+"
         "0.3*1000000*(r-getd0(radindex1,radindex2))^6);Ivdw=" +
         kVanDerWaals + ";radius1=or1+offset; radius2=or2+offset;neckScale=" + scale +
         "; neckCut=0.68; offset=" + offset;
}

std::string radiusByTanh(const std::string& inner, const std::string& offset) {
  return "1/(1/or-tanh(" + inner + ")/radius);psi=I*or; radius=or+offset; offset=" + offset;
}

const std::vector<Form>& forms() {
  static const std::vector<Form> all = [] {
    Form hct{kVanDerWaals, "1/(1/or-I)"};
    hct.hct = true;
    Form obc1{kVanDerWaals, radiusByTanh("0.8*psi+2.909125*psi^3", "0.009")};
    obc1.alpha = 0.8, obc1.gamma = 2.909125;
    Form obc2{kVanDerWaals, radiusByTanh("psi-0.8*psi^2+4.85*psi^3", "0.009")};
    obc2.alpha = 1, obc2.beta = 0.8, obc2.gamma = 4.85;
    Form gbn{integralWithNecks("0.361825", "0.009"),
             radiusByTanh("1.09511284*psi-1.907992938*psi^2+2.50798245*psi^3", "0.009")};
    gbn.alpha = 1.09511284, gbn.beta = 1.907992938, gbn.gamma = 2.50798245, gbn.neckScale = 0.361825;
    Form gbn2{integralWithNecks("0.826836", "0.0195141"),
              radiusByTanh("alpha*psi-beta*psi^2+gamma*psi^3", "0.0195141")};
    gbn2.offset = 0.0195141, gbn2.ownCoefficients = true, gbn2.neckScale = 0.826836;
    return std::vector<Form>{hct, obc1, obc2, gbn, gbn2};
  }();
  return all;
}

std::vector<std::string> parametersOf(const Form& form) {
  std::vector<std::string> names{"charge", "or", "sr"};
  if (form.ownCoefficients) names.insert(names.end(), {"alpha", "beta", "gamma"});
  if (form.neckScale > 0) names.emplace_back("radindex");
  return names;
}

/// A text in which each # of a pattern stands for a number: the numbers, or nothing if it is another text.
std::optional<std::vector<std::string>> numbersIn(const std::string& text, const std::string& pattern) {
  std::vector<std::string> numbers;
  std::size_t at = 0;
  for (const char c : pattern) {
    if (c != '#') {
      if (at >= text.size() || text[at++] != c) return {};
      continue;
    }
    const std::size_t end = text.find_first_not_of("0123456789.eE+-", at);
    std::string number = text.substr(at, end == std::string::npos ? end : end - at);
    char* rest = nullptr;
    const double value = std::strtod(number.c_str(), &rest);
    if (number.empty() || *rest != 0 || !std::isfinite(value)) return {};
    at += number.size();
    numbers.push_back(std::move(number));
  }
  if (at != text.size()) return {};
  return numbers;
}

double numberOf(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

std::string filled(const std::string& pattern, const std::vector<std::string>& numbers) {
  std::string text;
  std::size_t next = 0;
  for (const char c : pattern) {
    if (c == '#')
      text += numbers.at(next++);
    else
      text += c;
  }
  return text;
}

struct Term {
  std::string expression;
  CustomGBForce::ComputationType type;
  bool operator==(const Term& other) const { return expression == other.expression && type == other.type; }
};

std::vector<Term> energyTermsOf(const CustomGBForce& force) {
  std::vector<Term> terms(static_cast<std::size_t>(force.getNumEnergyTerms()));
  for (int k = 0; k < force.getNumEnergyTerms(); ++k)
    force.getEnergyTermParameters(k, terms[static_cast<std::size_t>(k)].expression,
                                  terms[static_cast<std::size_t>(k)].type);
  return terms;
}

/// Reads the terms that all forms share. False if they are others.
bool readEnergy(const CustomGBForce& force, const Form& form, bool hasSalt, bool hasCutoff,
                BornModel& model) {
  const std::vector<Term> terms = energyTermsOf(force);
  const std::string names = std::string("; solventDielectric=#; soluteDielectric=#; kappa=#; offset=#") +
                            (hasCutoff ? "; cutoff=#" : "");
  const auto charges = [&](const std::string& f) {
    return "138.935485*(1/soluteDielectric-" + (hasSalt ? "exp(-kappa*" + f + ")" : "1") +
           "/solventDielectric)*";
  };
  if (terms.size() < 2 || terms.size() > 3) return false;
  const auto given = numbersIn(terms[0].expression, "-0.5*" + charges("B") + "charge^2/B" + names);
  if (!given || terms[0].type != CustomGBForce::SingleParticle) return false;
  const std::string values = filled(names, *given);
  if (terms.size() == 3 &&
      !(terms[1] == Term{"28.3919551*(radius+0.14)^2*(radius/B)^6; radius=or+offset" + values,
                         CustomGBForce::SingleParticle}))
    return false;
  const std::string ofPair = "-" + charges("f") + "charge1*charge2" + (hasCutoff ? "*(1/f-#);" : "/f;") +
                             "f=sqrt(r^2+B1*B2*exp(-r^2/(4*B1*B2)))" + values;
  const auto shift = numbersIn(terms.back().expression, ofPair);
  if (!shift || terms.back().type != CustomGBForce::ParticlePairNoExclusions) return false;
  const double solvent = numberOf((*given)[0]), solute = numberOf((*given)[1]), kappa = numberOf((*given)[2]);
  if (solvent == 0 || solute == 0 || hasSalt != (kappa > 0) || kappa < 0) return false;
  if (numberOf((*given)[3]) != form.offset) return false;
  model.energy = {kCustomConstant, 1 / solute, 1 / solvent, kappa, hasCutoff ? numberOf((*shift)[0]) : 0};
  model.surface = terms.size() == 3 ? kCustomSurface : 0;
  return true;
}

bool readEnergy(const CustomGBForce& force, const Form& form, BornModel& model) {
  for (const bool hasSalt : {false, true})
    for (const bool hasCutoff : {false, true})
      if (readEnergy(force, form, hasSalt, hasCutoff, model)) return true;
  return false;
}

bool hasValues(const CustomGBForce& force, const Form& form) {
  if (force.getNumComputedValues() != 2) return false;
  std::string name, expression;
  CustomGBForce::ComputationType type;
  force.getComputedValueParameters(0, name, expression, type);
  if (name != "I" || expression != form.integral || type != CustomGBForce::ParticlePairNoExclusions)
    return false;
  force.getComputedValueParameters(1, name, expression, type);
  return name == "B" && expression == form.radius && type == CustomGBForce::SingleParticle;
}

bool hasParameters(const CustomGBForce& force, const Form& form) {
  if (force.getNumGlobalParameters() != 0 || force.getNumEnergyParameterDerivatives() != 0) return false;
  const std::vector<std::string> names = parametersOf(form);
  if (force.getNumPerParticleParameters() != static_cast<int>(names.size())) return false;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (force.getPerParticleParameterName(static_cast<int>(k)) != names[k]) return false;
  return true;
}

/// A table f(first, second) in rows. Of OpenMM's the first index is the quick one.
bool readTable(const CustomGBForce& force, int index, const std::string& name, int& side,
               std::vector<double>& rows) {
  const auto* const table =
      dynamic_cast<const OpenMM::Discrete2DFunction*>(&force.getTabulatedFunction(index));
  if (!table || force.getTabulatedFunctionName(index) != name) return false;
  int width, height;
  std::vector<double> values;
  table->getFunctionParameters(width, height, values);
  if (width != height || width < 1 || (index > 0 && width != side)) return false;
  side = width;
  rows.resize(values.size());
  const auto count = static_cast<std::size_t>(side);
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b) rows[a * count + b] = values[a + count * b];
  return true;
}

bool readNecks(const CustomGBForce& force, const Form& form, BornModel& model) {
  model.necks = {};
  if (form.neckScale == 0) return force.getNumTabulatedFunctions() == 0;
  model.necks.scale = form.neckScale;
  model.necks.reach = kNeckReach + 2 * form.offset;
  return force.getNumTabulatedFunctions() == 2 &&
         readTable(force, 0, "getd0", model.necks.kinds, model.necks.at) &&
         readTable(force, 1, "getm0", model.necks.kinds, model.necks.height);
}

/// Which of the forms it is, -1 if it is none.
int formOf(const CustomGBForce& force, BornModel& model) {
  for (std::size_t k = 0; k < forms().size(); ++k) {
    const Form& form = forms()[k];
    if (hasParameters(force, form) && hasValues(force, form) && readNecks(force, form, model) &&
        readEnergy(force, form, model))
      return static_cast<int>(k);
  }
  return -1;
}

BornModel::Particle particleOf(const std::vector<double>& parameters, const Form& form) {
  BornModel::Particle p{parameters.at(0), parameters.at(1), parameters.at(2), parameters.at(1) + form.offset,
                        form.alpha,       form.beta,        form.gamma};
  if (form.ownCoefficients) p.alpha = parameters.at(3), p.beta = parameters.at(4), p.gamma = parameters.at(5);
  if (form.neckScale > 0) {
    const double index = parameters.back();
    p.kind = index == std::nearbyint(index) && std::abs(index) < 1e6 ? static_cast<int>(index) : -1;
  }
  return p;
}

template <class Force>
std::string readMethod(const Force& force, BornModel& model) {
  if (force.getNonbondedMethod() == Force::NoCutoff)
    return "without a cutoff (NoCutoff) there are no lists to gain by";
  model.cutoff = force.getCutoffDistance();
  model.isPeriodic = force.usesPeriodicBoundaryConditions();
  return std::isfinite(model.cutoff) && model.cutoff > 0 ? "" : "the cutoff is not positive and finite";
}

}  // namespace

std::string readModel(const GBSAOBCForce& force, BornModel& model) {
  std::string reason = readMethod(force, model);
  if (!reason.empty()) return reason;
  model.countsInside = true;
  const double solute = force.getSoluteDielectric(), solvent = force.getSolventDielectric();
  const bool hasField = solute != 0 && solvent != 0;
  model.energy = {ONE_4PI_EPS0, hasField ? 1 / solute : 0, hasField ? 1 / solvent : 0, 0, 1 / model.cutoff};
  model.surface = 4 * M_PI * force.getSurfaceAreaEnergy();
  readChanges(force, model);
  return faultOf(model);
}

void readChanges(const GBSAOBCForce& force, BornModel& model) {
  model.particles.clear();
  for (int i = 0; i < force.getNumParticles(); ++i) {
    double charge, radius, scale;
    force.getParticleParameters(i, charge, radius, scale);
    const double a = radius - kOffset;
    model.particles.push_back({charge, a, scale * a, radius, 1, 0.8, 4.85});
  }
}

std::string readModel(const CustomGBForce& force, BornModel& model) {
  model.form = formOf(force, model);
  if (model.form < 0) return "a CustomGBForce other than those that openmm.app writes is not covered";
  std::string reason = readMethod(force, model);
  if (!reason.empty()) return reason;
  model.hct = forms()[static_cast<std::size_t>(model.form)].hct;
  readChanges(force, model);
  return faultOf(model);
}

void readChanges(const CustomGBForce& force, BornModel& model) {
  const Form& form = forms()[static_cast<std::size_t>(model.form)];
  model.particles.clear();
  if (!readNecks(force, form, model))
    throw OpenMM::OpenMMException("updateParametersInContext: a tabulated function has another shape");
  std::vector<double> parameters;
  for (int i = 0; i < force.getNumParticles(); ++i) {
    force.getParticleParameters(i, parameters);
    if (parameters.size() != parametersOf(form).size())
      throw OpenMM::OpenMMException("updateParametersInContext: particle " + std::to_string(i) + " has " +
                                    std::to_string(parameters.size()) + " parameters, not " +
                                    std::to_string(parametersOf(form).size()));
    model.particles.push_back(particleOf(parameters, form));
  }
}

}  // namespace OpenMMDCH
