// JSON as the laboratory writes it: members in their order, numbers with all their digits, those that JSON cannot say
// as null, and U+FFFD for bytes that are no UTF-8, which names of files may hold.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lab/statistics.h"

namespace fb::lab {

using Json = nlohmann::ordered_json;

Json json_of(double value);       // null where it is not finite
Json json_of(const Estimate& e);  // {"value": x, "interval95": [low, high]}
// On one line and without a line's end where `indent` is negative.
std::string json_text(const Json& json, int indent = 2);

}  // namespace fb::lab
