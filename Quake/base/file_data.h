// The bytes of a file, as who reads files hands them out: held in memory, or a part of the file itself that is mapped
// and costs only the pages that somebody looks at. Copies share them; they never change, and stay as long as a copy
// does.
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
  FileData(Bytes bytes) {  // NOLINT: whoever has bytes has a file's data
    auto owned = std::make_shared<const Bytes>(std::move(bytes));
    view_ = *owned;
    owner_ = std::move(owned);
  }
  // `owner` keeps what `view` shows.
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

// Gives a game's file by its name; nothing where there is none. It never throws.
using FileLoader = std::function<std::optional<FileData>(std::string_view name)>;

}  // namespace fb
