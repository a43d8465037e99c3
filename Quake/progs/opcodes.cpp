#include "progs/opcodes.h"

#include <array>

#include "base/check.h"
#include "progs/value.h"

namespace fb::progs {
namespace {

constexpr Operand kU = Operand::kUnused, kG = Operand::kGlobal, kJ = Operand::kJump;
constexpr std::array<OpInfo, kOpCount + 1> kOps = {{
    {"DONE", kG, kU, kU},       {"MUL_F", kG, kG, kG},      {"MUL_V", kG, kG, kG},      {"MUL_FV", kG, kG, kG},
    {"MUL_VF", kG, kG, kG},     {"DIV_F", kG, kG, kG},      {"ADD_F", kG, kG, kG},      {"ADD_V", kG, kG, kG},
    {"SUB_F", kG, kG, kG},      {"SUB_V", kG, kG, kG},      {"EQ_F", kG, kG, kG},       {"EQ_V", kG, kG, kG},
    {"EQ_S", kG, kG, kG},       {"EQ_E", kG, kG, kG},       {"EQ_FNC", kG, kG, kG},     {"NE_F", kG, kG, kG},
    {"NE_V", kG, kG, kG},       {"NE_S", kG, kG, kG},       {"NE_E", kG, kG, kG},       {"NE_FNC", kG, kG, kG},
    {"LE", kG, kG, kG},         {"GE", kG, kG, kG},         {"LT", kG, kG, kG},         {"GT", kG, kG, kG},
    {"LOAD_F", kG, kG, kG},     {"LOAD_V", kG, kG, kG},     {"LOAD_S", kG, kG, kG},     {"LOAD_ENT", kG, kG, kG},
    {"LOAD_FLD", kG, kG, kG},   {"LOAD_FNC", kG, kG, kG},   {"ADDRESS", kG, kG, kG},    {"STORE_F", kG, kG, kU},
    {"STORE_V", kG, kG, kU},    {"STORE_S", kG, kG, kU},    {"STORE_ENT", kG, kG, kU},  {"STORE_FLD", kG, kG, kU},
    {"STORE_FNC", kG, kG, kU},  {"STOREP_F", kG, kG, kU},   {"STOREP_V", kG, kG, kU},   {"STOREP_S", kG, kG, kU},
    {"STOREP_ENT", kG, kG, kU}, {"STOREP_FLD", kG, kG, kU}, {"STOREP_FNC", kG, kG, kU}, {"RETURN", kG, kU, kU},
    {"NOT_F", kG, kU, kG},      {"NOT_V", kG, kU, kG},      {"NOT_S", kG, kU, kG},      {"NOT_ENT", kG, kU, kG},
    {"NOT_FNC", kG, kU, kG},    {"IF", kG, kJ, kU},         {"IFNOT", kG, kJ, kU},      {"CALL0", kG, kU, kU},
    {"CALL1", kG, kU, kU},      {"CALL2", kG, kU, kU},      {"CALL3", kG, kU, kU},      {"CALL4", kG, kU, kU},
    {"CALL5", kG, kU, kU},      {"CALL6", kG, kU, kU},      {"CALL7", kG, kU, kU},      {"CALL8", kG, kU, kU},
    {"STATE", kG, kG, kU},      {"GOTO", kJ, kU, kU},       {"AND", kG, kG, kG},        {"OR", kG, kG, kG},
    {"BITAND", kG, kG, kG},     {"BITOR", kG, kG, kG},      {"end", kU, kU, kU},
}};

}  // namespace

const OpInfo& op_info(Op op) {
  FB_CHECK_LT(static_cast<std::size_t>(op), kOps.size());
  return kOps[static_cast<std::size_t>(op)];
}

const char* type_name(Type type) {
  constexpr std::array<const char*, 8> kNames = {"void",   "string", "float",    "vector",
                                                 "entity", "field",  "function", "pointer"};
  const auto i = static_cast<std::size_t>(type);
  return i < kNames.size() ? kNames[i] : "unknown";
}

}  // namespace fb::progs
