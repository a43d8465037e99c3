// Small things that everything which calls QuakeC from the middle of something needs.
#pragma once

#include "server/simulation/level.h"

namespace fb::sv {

// QuakeC's self and other are afterwards what they were: what touches another thing may itself be called from QuakeC.
class KeepSelfAndOther {
 public:
  explicit KeepSelfAndOther(progs::Vm& vm)
      : vm_(vm), self_(vm.get(progs::globals::self)), other_(vm.get(progs::globals::other)) {}
  ~KeepSelfAndOther() {
    vm_.set(progs::globals::self, self_);
    vm_.set(progs::globals::other, other_);
  }
  KeepSelfAndOther(const KeepSelfAndOther&) = delete;
  KeepSelfAndOther& operator=(const KeepSelfAndOther&) = delete;

 private:
  progs::Vm& vm_;
  EdictId self_, other_;
};

// Enumerations of defs.qc are floats.
inline int enum_of(const Edict& edict, progs::Field<float> field) { return progs::to_int(edict.get(field)); }

// "edict 5 (monster_ogre at 64 0 24)", for sentences about what a mod does.
std::string describe(Level& level, EdictId id);

}  // namespace fb::sv
