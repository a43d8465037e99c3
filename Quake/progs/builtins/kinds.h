// The standard builtins, a file for each kind.
#pragma once

#include "progs/builtins/builtins.h"

namespace fb::progs {

void add_math_builtins(BuiltinTable& table, const Services& services);
void add_string_builtins(BuiltinTable& table);
void add_string_style_builtins(BuiltinTable& table);  // strconv, case, padding, replacing
void add_info_builtins(BuiltinTable& table);          // infoadd, infoget
void add_text_tool_builtins(BuiltinTable& table);     // trimming, marks, URIs, checksums, dates
void add_integer_builtins(BuiltinTable& table);
void add_buffer_builtins(BuiltinTable& table, const Services& services);
void add_sprintf_builtin(BuiltinTable& table);
void add_tokenize_builtins(BuiltinTable& table);
void add_entity_builtins(BuiltinTable& table);
void add_entity_data_builtins(BuiltinTable& table);  // fields by number
void add_call_builtins(BuiltinTable& table);         // callfunction, copyentity, parseentitydata
void add_console_builtins(BuiltinTable& table, const Services& services);
void add_debug_builtins(BuiltinTable& table, const Services& services);
void add_file_builtins(BuiltinTable& table, const Services& services);
void add_rerelease_builtins(BuiltinTable& table);

}  // namespace fb::progs
