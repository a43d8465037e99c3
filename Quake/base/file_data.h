// The bytes of a file: held in memory, or a part of the file that is memory-mapped, which costs only the pages that are
// read. Copies share the bytes, which never change and live as long as the last copy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "base/bytes.h"

namespace fb {

class FileData {
 public:
  FileData() = default;
  FileData(Bytes bytes) {  // NOLINT: implicit on purpose
    auto owned = std::make_shared<const Bytes>(std::move(bytes));
    view_ = *owned;
    owner_ = std::move(owned);
  }
  // `owner` keeps the bytes of `view` alive.
  FileData(ByteView view, std::shared_ptr<const void> owner) : view_(view), owner_(std::move(owner)) {}

  const std::uint8_t* data() const { return view_.data(); }
  std::size_t size() const { return view_.size(); }
  bool empty() const { return view_.empty(); }
  auto begin() const { return view_.begin(); }
  auto end() const { return view_.end(); }
  std::string_view text() const { return {reinterpret_cast<const char*>(view_.data()), view_.size()}; }

 private:
  ByteView view_;
  std::shared_ptr<const void> owner_;
};

// Loads a game file by its name; nullopt if there is none. Never throws.
using FileLoader = std::function<std::optional<FileData>(std::string_view name)>;

}  // namespace fb
