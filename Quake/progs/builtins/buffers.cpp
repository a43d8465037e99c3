// DP_QC_STRINGBUFFERS: lists of strings that a mod makes, fills by number, sorts and joins. They go with the level.
#include <algorithm>
#include <map>
#include <memory>
#include <vector>

#include "console/console.h"
#include "progs/builtins/kinds.h"
#include "progs/vm.h"

namespace fb::progs {
namespace {

constexpr std::size_t kMostBuffers = 1024, kMostStrings = 1u << 16u, kMostBytes = 64u << 20u;

// A name as buf_cvarlist's patterns have it: * stands for anything.
bool matches(std::string_view name, std::string_view pattern) {
  std::size_t star = std::string_view::npos, tried = 0, n = 0, p = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      tried = n;
    } else if (p < pattern.size() && (pattern[p] == name[n] || pattern[p] == '?')) {
      ++n;
      ++p;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++tried;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

class Buffers {
 public:
  void create(Vm& vm) {
    vm.return_float(-1.0f);
    if (buffers_.size() >= kMostBuffers) return vm.warn("buf_create: there are too many buffers");
    int handle = 1;  // some mods take 0 for none
    while (buffers_.contains(handle)) ++handle;
    buffers_[handle];
    vm.return_float(static_cast<float>(handle));
  }

  void remove(Vm& vm) {
    if (Strings* buffer = buffer_parm(vm, 0)) {
      clear(*buffer);
      buffers_.erase(vm.parm_int(0));
    }
  }

  void size(Vm& vm) {
    const Strings* buffer = buffer_parm(vm, 0);
    vm.return_float(buffer ? static_cast<float>(buffer->size()) : 0.0f);
  }

  void copy(Vm& vm) {
    const Strings* from = buffer_parm(vm, 0);
    Strings* to = buffer_parm(vm, 1);
    if (!from || !to || from == to) return;
    const Strings strings = *from;
    clear(*to);
    for (std::size_t i = 0; i < strings.size(); ++i) put(vm, *to, i, strings[i]);
  }

  // buf_sort(buffer, how many letters count (0: all), whether backwards). Empty places go.
  void sort(Vm& vm) {
    Strings* buffer = buffer_parm(vm, 0);
    if (!buffer) return;
    const auto letters = vm.parm_int(1) > 0 ? static_cast<std::size_t>(vm.parm_int(1)) : std::string::npos;
    const bool backwards = vm.parm_float(2) != 0.0f;
    std::erase(*buffer, "");
    std::stable_sort(buffer->begin(), buffer->end(), [&](const std::string& a, const std::string& b) {
      const auto &first = backwards ? b : a, &second = backwards ? a : b;
      return std::string_view(first).substr(0, letters) < std::string_view(second).substr(0, letters);
    });
  }

  void implode(Vm& vm) {
    const Strings* buffer = buffer_parm(vm, 0);
    const std::string_view glue = vm.parm_string(1);
    std::string text;
    for (const std::string& string : buffer ? *buffer : Strings{}) {
      if (string.empty() || text.size() > StringTable::kMaxLength) continue;
      if (!text.empty()) text += glue;
      text += string;
    }
    vm.return_string(text);
  }

  void get(Vm& vm) {
    const Strings* buffer = buffer_parm(vm, 0);
    const auto i = static_cast<std::size_t>(vm.parm_int(1));
    vm.return_string(buffer && i < buffer->size() ? std::string_view((*buffer)[i]) : std::string_view());
  }

  void set(Vm& vm) {
    if (Strings* buffer = buffer_parm(vm, 0))
      put(vm, *buffer, static_cast<std::size_t>(vm.parm_int(1)), std::string(vm.parm_string(2)));
  }

  // bufstr_add(buffer, string, whether at the end or in the first empty place): the place, or -1.
  void add(Vm& vm) {
    vm.return_float(-1.0f);
    Strings* buffer = buffer_parm(vm, 0);
    if (!buffer) return;
    std::size_t place = buffer->size();
    if (vm.parm_float(2) == 0.0f)
      place = static_cast<std::size_t>(std::find(buffer->begin(), buffer->end(), "") - buffer->begin());
    if (put(vm, *buffer, place, std::string(vm.parm_string(1)))) vm.return_float(static_cast<float>(place));
  }

  void free(Vm& vm) {
    Strings* buffer = buffer_parm(vm, 0);
    const auto i = static_cast<std::size_t>(vm.parm_int(1));
    if (!buffer || i >= buffer->size()) return;
    put(vm, *buffer, i, "");
    while (!buffer->empty() && buffer->back().empty()) buffer->pop_back();
  }

  // buf_cvarlist(buffer, names wanted, names not wanted)
  void list_cvars(Vm& vm, const con::Console* console) {
    Strings* buffer = buffer_parm(vm, 0);
    if (!buffer || !console) return;
    clear(*buffer);
    const std::string_view wanted = vm.parm_string(1), unwanted = vm.parm_count() > 2 ? vm.parm_string(2) : "";
    const auto pattern_matches = [](std::string_view name, std::string_view pattern) {
      // A pattern without a star is a beginning, as in DarkPlaces.
      return pattern.find('*') == std::string_view::npos ? name.starts_with(pattern) : matches(name, pattern);
    };
    for (const con::Cvar* cvar : console->cvars())
      if (pattern_matches(cvar->name(), wanted) && (unwanted.empty() || !pattern_matches(cvar->name(), unwanted)))
        put(vm, *buffer, buffer->size(), cvar->name());
  }

 private:
  using Strings = std::vector<std::string>;

  Strings* buffer_parm(Vm& vm, int i) {
    const auto found = buffers_.find(vm.parm_int(i));
    if (found != buffers_.end()) return &found->second;
    vm.warn("there is no such string buffer");
    return nullptr;
  }
  void clear(Strings& buffer) {
    for (const std::string& string : buffer) bytes_ -= string.size();
    buffer.clear();
  }
  bool put(Vm& vm, Strings& buffer, std::size_t place, std::string string) {
    if (place >= kMostStrings || bytes_ + string.size() > kMostBytes) {
      vm.warn("a string buffer holds no more than that");
      return false;
    }
    if (place >= buffer.size()) buffer.resize(place + 1);
    bytes_ = bytes_ - buffer[place].size() + string.size();
    buffer[place] = std::move(string);
    return true;
  }

  std::map<int, Strings> buffers_;
  std::size_t bytes_ = 0;  // of all strings
};

}  // namespace

void add_buffer_builtins(BuiltinTable& table, const Services& services) {
  const auto buffers = std::make_shared<Buffers>();
  const auto set = [&](std::uint32_t number, std::string_view name, void (Buffers::*method)(Vm&)) {
    table.set(number, name, [buffers, method](Vm& vm) { ((*buffers).*method)(vm); });
  };
  set(460, "buf_create", &Buffers::create);
  set(461, "buf_del", &Buffers::remove);
  set(462, "buf_getsize", &Buffers::size);
  set(463, "buf_copy", &Buffers::copy);
  set(464, "buf_sort", &Buffers::sort);
  set(465, "buf_implode", &Buffers::implode);
  set(466, "bufstr_get", &Buffers::get);
  set(467, "bufstr_set", &Buffers::set);
  set(468, "bufstr_add", &Buffers::add);
  set(469, "bufstr_free", &Buffers::free);
  table.set(517, "buf_cvarlist", [buffers, console = services.console](Vm& vm) { buffers->list_cvars(vm, console); });
  table.add_extension("DP_QC_STRINGBUFFERS");
}

}  // namespace fb::progs
