// FRIK_FILE: text files of the mod, in the folder data/ of its game. A file is read whole when it is opened and written
// whole when it is closed, or with the table at the level's end. Then all that was written is put on the disk.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "base/log.h"
#include "fs/path.h"
#include "progs/builtins/kinds.h"
#include "progs/vm.h"

namespace fb::progs {
namespace {

constexpr std::size_t kMaxOpen = 64;
constexpr std::size_t kMaxBytes = 16u << 20u, kMaxBytesOpen = 64u << 20u;  // of a file, of all that are open
// What a file's opening or writing counts for in QuakeC's limit of statements, so that a loop which does nothing else
// ends before long.
constexpr std::int64_t kStatementsAFile = 2000, kBytesAStatement = 16;
constexpr int kMostWarnings = 3;  // of files that cannot be written, in a level
enum Mode { kRead = 0, kAppend = 1, kWrite = 2 };

class Files {
 public:
  explicit Files(const Services& services) : services_(services) {}
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;
  ~Files() {
    for (const auto& [handle, file] : open_) save(file);
    if (written_ && services_.flush_files) services_.flush_files();
  }

  // fopen(name, mode): a handle, or -1.
  void open(Vm& vm) {
    const auto name = fs::normalise(vm.parm_string(0));
    const int mode = vm.parm_int(1);
    vm.return_float(-1.0f);
    if (!name || open_.size() >= kMaxOpen) {
      vm.warn(name ? "fopen: too many files are open" : "fopen: no name for a file of the mod");
      return;
    }
    File file{"data/" + *name, "", 0, mode != kRead};
    vm.charge(kStatementsAFile);
    if (mode == kRead) {
      auto text = read(vm, file.name);
      if (!text) text = read(vm, *name);  // of the game itself
      if (!text) return;
      file.text = std::move(*text);
    } else if (mode == kAppend) {
      file.text = read(vm, file.name).value_or("");
    } else if (mode != kWrite) {
      vm.warn(fmt::format("fopen: {} is no mode", mode));
      return;
    }
    if (file.text.size() > kMaxBytesOpen - std::min(kMaxBytesOpen, bytes_open_)) {
      vm.warn(fmt::format("fopen: {}: files of more than {} bytes would be open", file.name, kMaxBytesOpen));
      return;
    }
    charge_for(vm, file);
    bytes_open_ += file.text.size();
    const int handle = first_unused();
    open_.emplace(handle, std::move(file));
    vm.return_float(static_cast<float>(handle));
  }

  void close(Vm& vm) {
    const auto found = open_.find(vm.parm_int(0));
    if (found == open_.end()) return complain(vm, "fclose");
    if (found->second.writing) {
      vm.charge(kStatementsAFile);
      charge_for(vm, found->second);
    }
    save(found->second);
    bytes_open_ -= found->second.text.size();
    open_.erase(found);
  }

  // The next line without its end; the null string behind the last.
  void gets(Vm& vm) {
    const auto found = open_.find(vm.parm_int(0));
    vm.return_string_id(StringId::kNull);
    if (found == open_.end() || found->second.writing) return complain(vm, "fgets");
    File& file = found->second;
    if (file.position >= file.text.size()) return;
    const std::size_t end = std::min(file.text.find('\n', file.position), file.text.size());
    std::string line = file.text.substr(file.position, end - file.position);
    file.position = end + 1;
    std::erase(line, '\r');
    vm.return_string(line);
  }

  void puts(Vm& vm) {
    const auto found = open_.find(vm.parm_int(0));
    if (found == open_.end() || !found->second.writing) return complain(vm, "fputs");
    const std::string text = vm.parm_text_from(1);
    File& file = found->second;
    if (text.size() > kMaxBytes - std::min(kMaxBytes, file.text.size()))
      return vm.warn(fmt::format("fputs: {} would have more than {} bytes", file.name, kMaxBytes));
    if (text.size() > kMaxBytesOpen - std::min(kMaxBytesOpen, bytes_open_))
      return vm.warn(fmt::format("fputs: {}: files of more than {} bytes would be open", file.name, kMaxBytesOpen));
    file.text += text;
    bytes_open_ += text.size();
  }

 private:
  struct File {
    std::string name, text;
    std::size_t position = 0;
    bool writing = false;
  };

  std::optional<std::string> read(Vm& vm, const std::string& name) const {
    if (!services_.read_file) return std::nullopt;
    const auto bytes = services_.read_file(name);
    if (!bytes) return std::nullopt;
    if (bytes->size() > kMaxBytes) {
      vm.warn(fmt::format("fopen: {} has {} bytes; at most {} can be read", name, bytes->size(), kMaxBytes));
      return std::nullopt;
    }
    return std::string(bytes->text());
  }
  void save(const File& file) {
    if (!file.writing || !services_.write_file) return;
    const ByteView bytes(reinterpret_cast<const std::uint8_t*>(file.text.data()), file.text.size());
    const Status status = services_.write_file(file.name, bytes);
    written_ |= status.ok();
    if (!status && refused_++ < kMostWarnings) log_warning("{}", status.error().message);
  }
  static void charge_for(Vm& vm, const File& file) {
    vm.charge(static_cast<std::int64_t>(file.text.size()) / kBytesAStatement);
  }
  // From 1 on: some mods take 0 for a failure, although the extension says -1.
  int first_unused() const {
    int handle = 1;
    while (open_.contains(handle)) ++handle;
    return handle;
  }
  static void complain(Vm& vm, const char* what) {
    vm.warn(fmt::format("{}: {} is no file that is open for this", what, vm.parm_float(0)));
  }

  Services services_;
  std::map<int, File> open_;
  std::size_t bytes_open_ = 0;  // of all texts in open_
  int refused_ = 0;
  bool written_ = false;
};

}  // namespace

void add_file_builtins(BuiltinTable& table, const Services& services) {
  const auto files = std::make_shared<Files>(services);
  table.set(110, "fopen", [files](Vm& vm) { files->open(vm); });
  table.set(111, "fclose", [files](Vm& vm) { files->close(vm); });
  table.set(112, "fgets", [files](Vm& vm) { files->gets(vm); });
  table.set(113, "fputs", [files](Vm& vm) { files->puts(vm); });
  table.add_extension("FRIK_FILE");
}

}  // namespace fb::progs
