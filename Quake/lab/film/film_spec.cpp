#include "lab/film/film_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "lab/json_reader.h"

namespace fb::lab {
namespace {

constexpr std::uint64_t kMostFilmFrame = 10'000'000;
constexpr std::uint64_t kLargestFilmSide = 8192;
constexpr std::size_t kMostLanes = 8;

std::string beside(const std::string& spec, const std::string& file) {
  return (std::filesystem::path(spec).parent_path() / file).lexically_normal().string();
}

// `count` numbers in brackets.
std::vector<double> numbers(JsonReader& reader, const std::string& key, const Json& value, std::size_t count,
                            double low, double high) {
  std::vector<double> list(count, low);
  if (!value.is_array() || value.size() != count) {
    reader.fail(key, fmt::format("\"{}\": {} numbers in [ ] are wanted", key, count));
    return list;
  }
  for (std::size_t i = 0; i < count; ++i) list[i] = reader.number_of(value[i], key, low, high);
  return list;
}

void read_what(JsonReader& reader, FilmSpec& film, const std::string& path) {
  film.scene = reader.text("scene");
  film.map = reader.text("map");
  film.demo = reader.text("demo");
  std::error_code ignored;
  if (!film.demo.empty() && std::filesystem::is_regular_file(beside(path, film.demo), ignored))
    film.demo = beside(path, film.demo);
  if (const Json* camera = reader.take("camera"))
    for (const double part : numbers(reader, "camera", *camera, 6, -1e6, 1e6))
      film.camera += fmt::format("{}{}", film.camera.empty() ? "" : ",", part);
  film.sets = reader.settings("set");
}

void read_frames(JsonReader& reader, FilmSpec& film) {
  const Json* frames = reader.take("frames");
  if (frames == nullptr || !frames->is_array() || frames->size() != 2)
    return reader.fail("frames", "\"frames\": [FIRST, LAST] is wanted");
  film.first = reader.whole_of((*frames)[0], "frames", kMostFilmFrame);
  film.last = reader.whole_of((*frames)[1], "frames", kMostFilmFrame);
  if (film.last < film.first) reader.fail("frames", "\"frames\": the last comes before the first");
  film.warmup = static_cast<std::uint32_t>(reader.whole("warmup", 0, kMostFilmFrame, 0));
  if (film.warmup > film.first)
    reader.fail("warmup", fmt::format("\"warmup\": {} frames are wanted, and {} come before \"frames\": [{}, {}]",
                                      film.warmup, film.first, film.first, film.last));
  film.fps = reader.number("fps", 1, 1000, 30);
}

bool one_of(JsonReader& reader, const std::string& key, const std::string& first, const std::string& second) {
  const std::string value = reader.text(key);
  if (!value.empty() && value != first && value != second)
    reader.fail(key, fmt::format("\"{}\": \"{}\" or \"{}\" is wanted", key, first, second));
  return value == second;
}

FilmZoom read_zoom(const JsonFile& file, JsonReader& reader, const Json& value, const FilmSpec& film) {
  FilmZoom zoom;
  JsonReader part(file, value, "zoom");
  const Json* to = part.take("to");
  if (to == nullptr) {
    part.fail("\"to\": [x, y, width, height] is wanted");
  } else {
    const auto rectangle = numbers(part, "to", *to, 4, 0, static_cast<double>(kLargestFilmSide));
    zoom.corner = vec2(rectangle[0], rectangle[1]);
    zoom.size = vec2(rectangle[2], rectangle[3]);
    const vec2 whole(film.size);
    if (zoom.size.x < 1 || zoom.size.y < 1 || zoom.corner.x + zoom.size.x > whole.x ||
        zoom.corner.y + zoom.size.y > whole.y)
      part.fail("to", fmt::format("\"to\": not within {}x{} pixels", film.size.x, film.size.y));
    else if (std::abs(zoom.size.x * whole.y - zoom.size.y * whole.x) > std::max(whole.x, whole.y))
      part.fail("to", "\"to\": its sides are not as those of \"size\"");
  }
  const Json* frames = part.take("frames");
  zoom.ends = film.frames() - 1;
  if (frames != nullptr) {
    const auto range = numbers(part, "frames", *frames, 2, 0, static_cast<double>(film.frames() - 1));
    zoom.begins = static_cast<std::uint32_t>(range[0]);
    zoom.ends = static_cast<std::uint32_t>(range[1]);
    if (zoom.ends < zoom.begins) part.fail("frames", "\"frames\": the last comes before the first");
  }
  if (auto status = part.end(); !status) reader.fail_with(status.error().message);
  return zoom;
}

Result<FilmLane> read_lane(const JsonFile& file, const Json& value, std::size_t index) {
  JsonReader reader(file, value, fmt::format("lanes[{}]", index));
  FilmLane lane;
  lane.name = reader.text("name");
  if (lane.name.empty()) reader.fail("\"name\": a text is wanted");
  lane.sets = reader.settings("set");
  lane.pictures = reader.text("pictures");
  if (!lane.pictures.empty()) {
    lane.pictures = beside(file.path(), lane.pictures);
    if (!lane.sets.empty()) reader.fail("set", "\"set\" is of a lane that is rendered, not of \"pictures\"");
  }
  if (auto status = reader.end(); !status) return status.error();
  return lane;
}

}  // namespace

bool FilmSpec::renders() const {
  return std::ranges::any_of(lanes, [](const FilmLane& lane) { return lane.pictures.empty(); });
}

Result<FilmSpec> read_film(const std::string& path) {
  auto file = JsonFile::read(path);
  if (!file) return file.error();
  JsonReader reader(*file, file->json());
  FilmSpec film;
  read_what(reader, film, path);
  read_frames(reader, film);
  if (const Json* size = reader.take("size")) {
    const auto sides = numbers(reader, "size", *size, 2, 8, static_cast<double>(kLargestFilmSide));
    film.size = uvec2(sides[0], sides[1]);
  }
  film.side_by_side = one_of(reader, "layout", "wipe", "side");
  film.sweep = reader.number("sweep", 0, 1e4, 0);
  film.equal_time = one_of(reader, "equal", "samples", "time");
  film.own_exposure = one_of(reader, "exposure", "first", "own");
  film.exr = one_of(reader, "format", "png", "exr");
  film.sound = reader.boolean("sound", true);
  film.reference_samples = static_cast<std::uint32_t>(reader.whole("reference_samples", 0, 1u << 20u, 0));
  if (const std::string estimator = reader.text("reference_estimator"); !estimator.empty())
    film.reference_estimator = estimator;
  if (const Json* zoom = reader.take("zoom"); zoom != nullptr && !reader.failed())
    film.zoom = read_zoom(*file, reader, *zoom, film);
  const Json* lanes = reader.take("lanes");
  if (lanes == nullptr || !lanes->is_array() || lanes->empty() || lanes->size() > kMostLanes)
    reader.fail("lanes", fmt::format("\"lanes\": 1 to {} of them in [ ] are wanted", kMostLanes));
  if (auto status = reader.end(); !status) return status.error();
  for (std::size_t i = 0; i < lanes->size(); ++i) {
    auto lane = read_lane(*file, (*lanes)[i], i);
    if (!lane) return lane.error();
    film.lanes.push_back(std::move(*lane));
  }
  const int views = int{!film.scene.empty()} + int{!film.map.empty()} + int{!film.demo.empty()};
  if (film.renders() && views != 1)
    return Error{fmt::format("{}: one of \"scene\", \"map\" and \"demo\" is wanted", path)};
  if (film.equal_time && !film.lanes.front().pictures.empty())
    return Error{fmt::format("{}: \"equal\": \"time\" is that of the first lane, which must be rendered", path)};
  return film;
}

}  // namespace fb::lab
