#include "lab/compare/compare_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <map>
#include <string_view>

#include "base/hash.h"
#include "lab/compare/flicker.h"
#include "lab/image_io.h"
#include "lab/json.h"
#include "shared/color.h"
#include "shared/tone.h"

namespace fb::lab {
namespace {

// A file of either kind; `stored` is what is measured, linear() what FLIP looks at.
struct Loaded {
  bool is_linear = true;
  Reference stored;
};

bool has_extension(const std::string& path, std::string_view extension) {
  if (path.size() < extension.size()) return false;
  return std::equal(extension.begin(), extension.end(), path.end() - static_cast<std::ptrdiff_t>(extension.size()),
                    [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

Result<Loaded> load(const std::string& path) {
  if (has_extension(path, ".exr")) {
    auto picture = read_exr_picture(path);
    if (!picture) return picture.error();
    return Loaded{true, std::move(picture->content)};
  }
  if (has_extension(path, ".png")) {
    auto picture = read_png_picture(path);
    if (!picture) return picture.error();
    return Loaded{false, Reference{std::move(*picture), {}}};
  }
  return Error{fmt::format("{}: an .exr or a .png file is wanted", path)};
}

void zero_what_is_not_finite(Picture& picture) {
  for (vec3& p : picture.pixels)
    if (!finite(p)) p = vec3(0.0f);
}

Picture at_exposure(Picture picture, double stops) {
  for (vec3& p : picture.pixels) p *= static_cast<float>(std::exp2(stops));
  return picture;  // LDR-FLIP cuts it
}

Status check_pair(const CompareJob& job, const Loaded& reference, const Loaded& test, const std::string& file) {
  if (test.is_linear != reference.is_linear) {
    return Error{fmt::format("{} and {}: an EXR is compared with EXRs, a PNG with PNGs", job.reference, file)};
  }
  const Picture &r = reference.stored.mean, &t = test.stored.mean;
  if (!r.same_size(t)) {
    return Error{
        fmt::format("{}: {}x{} pixels, but {} has {}x{}", file, t.width, t.height, job.reference, r.width, r.height)};
  }
  return ok_status();
}

// As a screen shows it: sRGB values. A linear picture is cut at 1 after the exposure, as for LDR-FLIP.
Picture displayed(const Picture& picture, bool linear, double stops) {
  if (!linear) return picture;
  Picture shown = at_exposure(picture, stops);
  for (vec3& p : shown.pixels) p = shared::srgb_from_linear(glm::clamp(p, 0.0f, 1.0f));
  return shown;
}

std::vector<Figure> error_figures(const Errors& e, const Loaded& reference, const PicturePair& pair) {
  std::vector<Figure> figures;
  for (const Metric& metric : metrics())
    if (metric.holds(reference.is_linear, !reference.stored.variance.empty()))
      figures.push_back(
          {metric.name, metric.value != nullptr ? metric.value(e) : metric.of_pictures(pair), metric.multiplies});
  return figures;
}

// What a reference that `picture` kept says of where things were.
Result<Guides> read_guides(const std::string& path) {
  const auto image = read_exr(path);
  if (!image) return image.error();
  Guides guides{image->width(), image->height(), std::vector<vec2>(image->pixels()), {}, {}, {}, {}};
  const std::vector<float>*x = image->channel("motion.X"), *y = image->channel("motion.Y"), *z = image->channel("Z"),
        *before = image->channel("previous.Z");
  if (x == nullptr || y == nullptr || z == nullptr || before == nullptr)
    return Error{fmt::format(
        "{}: flicker wants motion.X, motion.Y, Z and previous.Z, as references that `picture` keeps have", path)};
  for (std::size_t i = 0; i < guides.motion.size(); ++i) guides.motion[i] = vec2((*x)[i], (*y)[i]);
  guides.depth = *z;
  guides.depth_before = *before;
  return guides;
}

// Of the pair's frame after the former one.
Result<double> flicker_of(const CompareJob& job, const PicturePair& pair) {
  const auto reference = load(job.former_reference), test = load(job.former_test);
  if (!reference) return reference.error();
  if (!test) return test.error();
  const auto guides_before = read_guides(job.former_reference), guides = read_guides(job.reference);
  if (!guides_before) return guides_before.error();
  if (!guides) return guides.error();
  for (const auto& [loaded, path] :
       {std::pair(&*reference, &job.former_reference), std::pair(&*test, &job.former_test)}) {
    if (!loaded->is_linear) return Error{fmt::format("{}: flicker is of EXR files", *path)};
    if (!loaded->stored.mean.same_size(pair.test))
      return Error{fmt::format("{}: another size than {}", *path, job.reference)};
  }
  Picture before = test->stored.mean;
  zero_what_is_not_finite(before);
  const Picture shown_reference = displayed(reference->stored.mean, true, job.exposure),
                shown_test = displayed(before, true, job.exposure);
  return flicker({shown_reference, shown_test, *guides_before}, {pair.shown_reference, pair.shown_test, *guides});
}

// FLIP's figures, and its map for a picture.
std::vector<float> add_flip(std::vector<Figure>& figures, const Comparison& c, const Picture& reference,
                            const Picture& test) {
  const double ppd = c.job.pixels_per_degree;
  if (!c.linear) {
    auto map = flip::ldr_flip(decoded(reference), decoded(test), ppd);
    figures.push_back({"flip", flip::mean_of(map)});
    return map;
  }
  const double stops = c.job.exposure;
  figures.push_back(
      {"flip_ldr", flip::mean_of(flip::ldr_flip(at_exposure(reference, stops), at_exposure(test, stops), ppd))});
  auto map = flip::hdr_flip(reference, test, *c.exposures, ppd);
  figures.push_back({"flip_hdr", flip::mean_of(map)});
  return map;
}

void summarise(Comparison& c) {
  for (std::size_t f = 0; f < c.files.front().figures.size(); ++f) {
    std::vector<double> values;
    for (const ComparedFile& file : c.files) values.push_back(file.figures[f].value);
    const Figure& figure = c.files.front().figures[f];
    // An error that is all noise of the reference may be negative, and has no logarithm.
    const bool positive = std::ranges::all_of(values, [](double v) { return v > 0; });
    Estimate typical = figure.multiplies && positive ? factor_over_runs(values) : mean_over_runs(values);
    if (figure.name == "bias") {  // the reference's error is that of all runs
      const double of_reference = 1.96 * c.reference_bias_error;
      const double half = std::hypot(typical.interval.high - typical.value, of_reference);
      typical.interval = {typical.value - half, typical.value + half};
    }
    c.spreads.push_back({figure.name, mean(values), typical});
  }
}

// Adds the largest of a file's squared errors, of which tail_shape is told; `total`: pixels of all files.
void add_largest(std::vector<double>& largest, const Picture& reference, const Picture& test, std::size_t total) {
  std::vector<double> errors(test.pixels.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const vec3 d = test.pixels[i] - reference.pixels[i];
    errors[i] = (double{d.x} * d.x + double{d.y} * d.y + double{d.z} * d.z) / 3;
  }
  const std::size_t kept = std::min(errors.size(), tail_count(total) + 1);
  std::ranges::partial_sort(errors, errors.begin() + static_cast<std::ptrdiff_t>(kept), std::greater<>());
  largest.insert(largest.end(), errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(kept));
}

// What a picture has none of, as a small one has no ms_ssim, is a dash.
std::string figure_text(double value) { return std::isnan(value) ? "-" : fmt::format("{:.6g}", value); }

}  // namespace

Result<Comparison> compare(const CompareJob& job) {
  Comparison c;
  c.job = job;
  if (!job.flip_map.empty() && job.tests.size() != 1) return Error{"--flip-map shows one picture; give one TEST"};
  if (!job.flip_map.empty() && !job.flip) return Error{"--flip-map wants FLIP; leave out --no-flip"};
  if (!job.former_reference.empty() && job.tests.size() != 1) return Error{"--former is of one picture; give one TEST"};
  auto reference = load(job.reference);
  if (!reference) return reference.error();
  const Picture& r = reference->stored.mean;
  if (auto status = check_reference(reference->stored, job.reference); !status) return status.error();
  for (const vec3& p : r.pixels) {
    c.reference_mean += (double{p.x} + p.y + p.z) / (3.0 * static_cast<double>(r.pixels.size()));
  }
  c.linear = reference->is_linear;
  c.width = r.width;
  c.height = r.height;
  if (c.linear && job.flip) c.exposures = flip::choose_exposures(r);
  const Picture shown_reference = displayed(r, c.linear, job.exposure);
  Runs runs;
  std::vector<double> largest;                // of the pixels' squared errors
  std::map<std::uint64_t, std::string> seen;  // file by the hash of its pixels
  for (const std::string& file : job.tests) {
    auto test = load(file);
    if (!test) return test.error();
    if (auto status = check_pair(job, *reference, *test, file); !status) return status.error();
    Picture& t = test->stored.mean;
    MetricOptions options = job.metrics;
    if (!c.linear && !(options.peak > 0)) options.peak = 1;
    const Errors errors = measure(reference->stored, t, options);
    c.peak = errors.peak;
    if (!reference->stored.variance.empty()) c.reference_variance = errors.reference_variance;
    c.reference_bias_error = errors.reference_bias_error;
    zero_what_is_not_finite(t);
    const Picture shown_test = displayed(t, c.linear, job.exposure);
    const PicturePair pair{r, t, shown_reference, shown_test};
    ComparedFile& row = c.files.emplace_back(
        ComparedFile{file, error_figures(errors, *reference, pair), errors.not_finite, error_spectrum(r, t)});
    if (!job.former_reference.empty()) {
      const auto value = flicker_of(job, pair);
      if (!value) return value.error();
      row.figures.push_back({"flicker", *value});
    }
    if (job.flip) {
      const auto map = add_flip(row.figures, c, r, t);
      if (!job.flip_map.empty()) {
        if (auto status = write_heat_map(job.flip_map, c.width, c.height, map); !status) return status.error();
      }
    }
    // The same picture again is no other run, and would make intervals narrow.
    const auto [first, is_new] = seen.emplace(hash_span(std::span<const vec3>(t.pixels)), file);
    if (!is_new && job.tests.size() > 1)
      return Error{
          fmt::format("{}: the same picture as {}: runs want seeds of their own (r_seed)", file, first->second)};
    runs.add(t);
    if (job.tests.size() > 1) add_largest(largest, r, t, job.tests.size() * t.pixels.size());
  }
  if (c.files.size() > 1) {
    summarise(c);
    const double shape = tail_shape(std::move(largest), c.files.size() * r.pixels.size());
    if (!std::isnan(shape)) c.tail = shape;
    if (c.linear) {
      c.variance = runs.variance();
      c.bias_squared = runs.bias_squared(reference->stored);
    }
  }
  return c;
}

std::string comparison_table(const Comparison& c) {
  std::string out = fmt::format("{}: {}x{}, {}, mean {:.6g}", c.job.reference, c.width, c.height,
                                c.linear ? "linear" : "sRGB values as stored, 0 to 1", c.reference_mean);
  if (c.reference_variance)
    out += fmt::format(", variance {:.3g} (taken off where it says corrected)", *c.reference_variance);
  out += '\n';
  if (c.exposures) {
    out += fmt::format("HDR-FLIP: {} exposures from {:+.2f} to {:+.2f} stops\n", c.exposures->count, c.exposures->start,
                       c.exposures->stop);
  }
  for (const ComparedFile& file : c.files) {
    out += fmt::format("\n{}\n", file.file);
    for (const Figure& f : file.figures) out += fmt::format("  {:18} {}\n", f.name, figure_text(f.value));
    if (file.not_finite > 0) out += fmt::format("  {} pixels are not finite and counted as zero\n", file.not_finite);
  }
  if (c.spreads.empty()) return out;
  const bool enough = c.files.size() >= kFewestRuns;
  out += fmt::format("\n{} files: mean; {}\n", c.files.size(),
                     enough ? "what a typical one has, 95% interval" : too_few_runs(c.files.size()));
  for (const Spread& s : c.spreads) {
    out += fmt::format("  {:18} {:<12}", s.name, figure_text(s.mean));
    if (s.typical.has_interval())
      out +=
          fmt::format(" {:<12.6g} [{:.6g}, {:.6g}]", s.typical.value, s.typical.interval.low, s.typical.interval.high);
    out += '\n';
  }
  if (c.variance) {
    out += fmt::format("  {:18} {:.6g}\n  {:18} {:.6g}\n", "variance", *c.variance, "bias_squared", *c.bias_squared);
  }
  if (c.tail && *c.tail > kHeavyTail)
    out += fmt::format(
        "\nThe largest errors fall off so slowly that their mean has no variance (Pareto's shape {:.2f}, above {}): "
        "rare "
        "samples\nrule, and what these {} files lack of them no interval and no mean here knows. Take more runs.\n",
        *c.tail, kHeavyTail, c.files.size());
  return out;
}

std::string comparison_json(const Comparison& c) {
  Json json{{"reference", c.job.reference},
            {"linear", c.linear},
            {"width", c.width},
            {"height", c.height},
            {"reference_mean", c.reference_mean}};
  if (c.reference_variance) json["reference_variance"] = *c.reference_variance;
  if (c.linear) json["epsilon"] = c.job.metrics.epsilon;
  json["peak"] = c.peak;
  if (c.job.flip) json["pixels_per_degree"] = c.job.pixels_per_degree;
  if (c.exposures)
    json["hdr_flip_exposures"] = {
        {"start", c.exposures->start}, {"stop", c.exposures->stop}, {"count", c.exposures->count}};
  std::vector<double> frequencies;
  for (std::size_t i = 1; i <= kSpectrumBins; ++i) frequencies.push_back(static_cast<double>(i) / (2 * kSpectrumBins));
  json["files"] = Json::array();
  for (const ComparedFile& compared : c.files) {
    Json& file = json["files"].emplace_back(Json{{"file", compared.file}});
    for (const Figure& f : compared.figures) file[f.name] = f.value;
    file["not_finite"] = compared.not_finite;
    file["error_spectrum"] = {{"low_frequencies_of_white_noise", compared.spectrum.white},
                              {"cycles_per_pixel_up_to", frequencies},
                              {"power", compared.spectrum.power}};
  }
  Json& runs = json["runs"] = Json::object();
  for (const Spread& s : c.spreads) runs[s.name] = {{"mean", s.mean}, {"typical", json_of(s.typical)}};
  if (c.variance) {
    runs["variance"] = *c.variance;
    runs["bias_squared"] = *c.bias_squared;
  }
  if (c.tail) runs["tail_shape"] = *c.tail;
  return json_text(json);
}

std::string comparison_csv(const Comparison& c) {
  std::string out = "file";
  for (const Figure& f : c.files.front().figures) out += ',' + f.name;
  out += ",not_finite\n";
  for (const ComparedFile& file : c.files) {
    std::string name = file.file;
    for (std::size_t at = 0; (at = name.find('"', at)) != std::string::npos; at += 2) name.insert(at, 1, '"');
    out += '"' + name + '"';
    for (const Figure& f : file.figures) out += fmt::format(",{}", f.value);
    out += fmt::format(",{}\n", file.not_finite);
  }
  return out;
}

}  // namespace fb::lab
