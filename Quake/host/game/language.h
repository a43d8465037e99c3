// The cvar `language`, and the files of texts that it names: localization/loc_LANGUAGE.txt (console/localization.h),
// in the game's folders and paks, beside these folders, and in the 2021 re-release's QuakeEX.kpf. All are read; of two
// texts of one key that of the file found first counts. What a language lacks is English.
#pragma once

#include "console/console.h"
#include "fs/filesystem.h"

namespace fb::host {

// Reads them into the console, now and whenever the cvar changes. Console and files must outlive each other's use: the
// handlers of the cvar call `files`.
void register_language(con::Console& console, const fs::FileSystem& files);

}  // namespace fb::host
