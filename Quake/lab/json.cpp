#include "lab/json.h"

#include <cmath>

namespace fb::lab {

Json json_of(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json json_of(const Estimate& e) {
  return {{"value", json_of(e.value)}, {"interval95", {json_of(e.interval.low), json_of(e.interval.high)}}};
}

std::string json_text(const Json& json, int indent) {
  std::string text = json.dump(indent, ' ', false, Json::error_handler_t::replace);
  if (indent >= 0) text += '\n';
  return text;
}

}  // namespace fb::lab
