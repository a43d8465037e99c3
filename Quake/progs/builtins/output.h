// What builtins print and where: text comes in pieces, the log wants whole lines.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "progs/builtins/builtins.h"

namespace fb::con {
class Localization;
}

namespace fb::progs {

// The parameters from `first` on as players read them: keys and placeholders become texts of the console's language.
std::string message_text(Vm& vm, int first, const con::Localization* localization);
const con::Localization* localization_of(const Services& services);

// services.print, or what collects the pieces of a line for the log.
std::function<void(std::string_view)> output_of(const Services& services);

}  // namespace fb::progs
