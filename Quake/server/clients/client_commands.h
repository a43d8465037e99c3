// Commands that players send as text: an allow-list. Nothing of what they send reaches the console.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "server/clients/clients.h"

namespace fb::sv {

// Runs what is on the list and allowed at this stage; the rest is ignored. Players from afar who send too many are told
// so once and not heard until they have been silent for a while. The client may be gone afterwards.
void run_client_command(Clients& clients, ServerClient& client, std::string_view text, double now);

// For `status`: lines with an end. Addresses are for the server's own console, and who plays in the same program.
std::string status_text(Clients& clients, bool with_addresses, double now);

}  // namespace fb::sv
