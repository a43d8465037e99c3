#include "lab/image_io.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticities.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <system_error>

#include "base/check.h"
#include "formats/image_write.h"
#include "fs/file.h"
#include "fs/temporary_file.h"

namespace fb::lab {
namespace {

// Pictures can be made again, so they need not be on the disk at once.
Result<fs::TemporaryFile> begin_picture(const std::string& path) {
  const auto target = fs::output_path(path);
  if (!target) return target.error();
  std::error_code code;
  if (std::filesystem::exists(*target, code) && !std::filesystem::is_regular_file(*target, code))
    return Error{fmt::format("{}: cannot be written: it is no file", path)};
  const std::filesystem::path folder = target->parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, code))  // a mistyped one is not made
    return Error{fmt::format("{}: cannot be written: there is no folder {}", path, folder.generic_string())};
  return fs::TemporaryFile::create(*target);
}

Status write_whole(const std::string& path, std::span<const std::uint8_t> data) {
  auto file = begin_picture(path);
  if (!file) return file.error();
  if (auto status = file->append(data); !status) return status;
  return file->commit(fs::Flush::kLater);
}

Imf::Slice float_slice(const std::vector<float>& plane, std::size_t width) {
  char* base = reinterpret_cast<char*>(const_cast<float*>(plane.data()));
  return Imf::Slice(Imf::FLOAT, base, sizeof(float), sizeof(float) * width);
}

// OpenEXR converts what it reads, but wants to be given what it shall write.
std::vector<half> to_half(const std::vector<float>& plane) {
  std::vector<half> halves(plane.size());
  std::transform(plane.begin(), plane.end(), halves.begin(), [](float value) { return half(value); });
  return halves;
}

}  // namespace

void ExrImage::add_channel(const std::string& name, std::vector<float> values) {
  FB_CHECK_EQ(values.size(), pixels());
  channels_[name] = std::move(values);
}

void ExrImage::add_colors(const std::string& prefix, std::span<const vec3> colors) {
  for (int c = 0; c < 3; ++c) {
    std::vector<float> plane(colors.size());
    std::ranges::transform(colors, plane.begin(), [c](const vec3& color) { return color[c]; });
    add_channel(prefix + "RGB"[c], std::move(plane));
  }
}

const std::vector<float>* ExrImage::channel(const std::string& name) const {
  const auto found = channels_.find(name);
  return found == channels_.end() ? nullptr : &found->second;
}

Status write_png(const std::string& path, std::uint32_t width, std::uint32_t height,
                 std::span<const std::uint32_t> pixels) {
  const auto file = formats::encode_png(width, height, pixels);
  if (!file) return Error{fmt::format("{}: cannot be written: {}", path, file.error().message)};
  return write_whole(path, *file);
}

Status write_exr(const std::string& path, const ExrImage& image, ExrPixels kind) {
  FB_CHECK(image.pixels() > 0 && !image.channels().empty());
  const Imf::PixelType type = kind == ExrPixels::kHalf ? Imf::HALF : Imf::FLOAT;
  auto temporary = begin_picture(path);
  if (!temporary) return temporary.error();
  try {
    Imf::Header header(static_cast<int>(image.width()), static_cast<int>(image.height()));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::addChromaticities(header, Imf::Chromaticities());  // Rec.709 and D65
    for (const auto& [name, value] : image.texts()) header.insert(name, Imf::StringAttribute(value));
    Imf::FrameBuffer buffer;
    std::map<std::string, std::vector<half>> halves;
    for (const auto& [name, plane] : image.channels()) {
      header.channels().insert(name, Imf::Channel(type));
      if (kind == ExrPixels::kFloat) {
        buffer.insert(name, float_slice(plane, image.width()));
      } else {
        std::vector<half>& converted = halves[name] = to_half(plane);
        buffer.insert(name, Imf::Slice(Imf::HALF, reinterpret_cast<char*>(converted.data()), sizeof(half),
                                       sizeof(half) * image.width()));
      }
    }
    Imf::OutputFile file(temporary->path().string().c_str(), header, 0);
    file.setFrameBuffer(buffer);
    file.writePixels(static_cast<int>(image.height()));
  } catch (const std::exception& failure) {
    return Error{fmt::format("{}: cannot be written: {}", path, failure.what())};
  }
  return temporary->commit(fs::Flush::kLater);
}

Result<ExrImage> read_exr(const std::string& path) {
  try {
    Imf::InputFile file(path.c_str(), 0);
    const Imf::Header& header = file.header();
    const Imath::Box2i window = header.dataWindow();
    const std::uint64_t width = static_cast<std::uint64_t>(std::int64_t{window.max.x} - window.min.x + 1);
    const std::uint64_t height = static_cast<std::uint64_t>(std::int64_t{window.max.y} - window.min.y + 1);
    std::uint64_t count = 0;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c, ++count) {
      if (c.channel().xSampling != 1 || c.channel().ySampling != 1) {
        return Error{fmt::format("{}: channel {} is subsampled, which is not supported", path, c.name())};
      }
    }
    // Each factor is below 2^32, so the products are compared by division.
    if (count == 0 || width > kMaxExrValues / height || count > kMaxExrValues / (width * height)) {
      return Error{
          fmt::format("{}: {} channels of {}x{} pixels; at least 1 channel and at most {} values in all can be read",
                      path, count, width, height, kMaxExrValues)};
    }
    if (!file.isComplete()) return Error{fmt::format("{}: the file is not complete", path)};

    ExrImage image(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
    std::map<std::string, std::vector<float>> planes;
    Imf::FrameBuffer buffer;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
      std::vector<float>& plane = planes[c.name()];
      plane.resize(image.pixels());
      buffer.insert(c.name(), Imf::Slice::Make(Imf::FLOAT, plane.data(), window, sizeof(float), sizeof(float) * width));
    }
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
    for (auto& [name, plane] : planes) image.add_channel(name, std::move(plane));
    for (auto a = header.begin(); a != header.end(); ++a) {
      if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute())) {
        image.set_text(a.name(), text->value());
      }
    }
    return image;
  } catch (const std::exception& failure) {
    return Error{fmt::format("{}: cannot be read: {}", path, failure.what())};
  }
}

}  // namespace fb::lab
