#include "progs/builtins/builtins.h"

#include "progs/builtins/kinds.h"

namespace fb::progs {

BuiltinTable standard_builtins(const Services& services) {
  BuiltinTable table;
  add_math_builtins(table, services);
  add_string_builtins(table);
  add_string_style_builtins(table);
  add_info_builtins(table);
  table.add_extension("FTE_STRINGS");  // the three above together
  add_text_tool_builtins(table);
  add_integer_builtins(table);
  add_buffer_builtins(table, services);
  add_sprintf_builtin(table);
  add_tokenize_builtins(table);
  add_entity_builtins(table);
  add_entity_data_builtins(table);
  add_call_builtins(table);
  add_console_builtins(table, services);
  add_debug_builtins(table, services);
  add_file_builtins(table, services);
  add_rerelease_builtins(table);
  table.add_extension("DP_QC_MULTIPLETEMPSTRINGS");
  table.add_extension("ZQ_QC_STRINGS");    // those of FRIK_FILE
  table.add_extension("DP_QC_AUTOCVARS");  // progs/autocvars.h, of those who run a program
  return table;
}

}  // namespace fb::progs
