// The 66 opcodes of progs.dat version 6, and what each does with its operands.
#pragma once

#include <cstdint>

namespace fb::progs {

enum class Op : std::uint16_t {
  kDone,
  kMulF,
  kMulV,
  kMulFV,
  kMulVF,
  kDivF,
  kAddF,
  kAddV,
  kSubF,
  kSubV,
  kEqF,
  kEqV,
  kEqS,
  kEqE,
  kEqFnc,
  kNeF,
  kNeV,
  kNeS,
  kNeE,
  kNeFnc,
  kLe,
  kGe,
  kLt,
  kGt,
  kLoadF,
  kLoadV,
  kLoadS,
  kLoadEnt,
  kLoadFld,
  kLoadFnc,
  kAddress,
  kStoreF,
  kStoreV,
  kStoreS,
  kStoreEnt,
  kStoreFld,
  kStoreFnc,
  kStorepF,
  kStorepV,
  kStorepS,
  kStorepEnt,
  kStorepFld,
  kStorepFnc,
  kReturn,
  kNotF,
  kNotV,
  kNotS,
  kNotEnt,
  kNotFnc,
  kIf,
  kIfNot,
  kCall0,
  kCall1,
  kCall2,
  kCall3,
  kCall4,
  kCall5,
  kCall6,
  kCall7,
  kCall8,
  kState,
  kGoto,
  kAnd,
  kOr,
  kBitAnd,
  kBitOr,
  // Ours, behind the last statement: what runs into it has run out of its function.
  kEnd,
};
constexpr std::uint16_t kOpCount = 66;

// Operands are indices of globals, or for jumps (the last operand in use of kIf, kIfNot and kGoto) signed numbers of
// statements; the others may hold anything.
enum class Operand : std::uint8_t { kUnused, kGlobal, kJump };
struct OpInfo {
  const char* name;  // "ADD_F"
  Operand a, b, c;
};
const OpInfo& op_info(Op op);

}  // namespace fb::progs
