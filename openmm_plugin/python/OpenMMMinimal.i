// SPDX-License-Identifier: MIT
//
// What the wrappers need to know of OpenMM's own Python module; that it is imported from there is what makes its
// types and ours the same for both.
namespace OpenMM {
class Force {
 public:
  virtual ~Force();
};
class NonbondedForce : public Force {};
class Context {};
}  // namespace OpenMM
