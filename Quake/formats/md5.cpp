// Parses MD5 models: texts of words, numbers and braces. Joints of a mesh are in the model's space; those of a frame
// are in their parent's.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <glm/gtc/quaternion.hpp>

#include "base/number.h"
#include "formats/posed_model.h"

namespace fb::formats {
namespace {

constexpr std::uint32_t kMostJoints = 4096, kMostWeights = 64;  // weights of one vertex
constexpr std::uint32_t kMost = 1u << 22u;                      // of anything else
constexpr std::uint64_t kMostJointPoses = 1u << 24u;
constexpr int kComponents = 6;  // of a joint in a frame: place, orientation

// Words of a text; a sign stands alone, what is in quotes is one word. After the first fault there are none.
class Words {
 public:
  explicit Words(const Md5Text& source) : size_(source.text.size()), text_(source.text), name_(source.name) { next(); }

  bool at_end() const { return word_.empty() && !quoted_; }
  bool failed() const { return error_.has_value(); }
  Error error() const { return *error_; }

  void refuse(std::string_view cause) {
    if (!error_) error_ = Error{fmt::format("{}: offset {} (line {}): {}", name_, taken_.offset, taken_.line, cause)};
    text_ = word_ = {};
    quoted_ = false;
  }
  bool next_is(std::string_view word) const { return !quoted_ && word_ == word; }
  bool take(std::string_view word) {
    if (!next_is(word)) return false;
    next();
    return true;
  }
  void expect(std::string_view word) {
    if (take(word)) return;
    taken_ = place_;
    refuse(fmt::format("\"{}\" is wanted, not \"{}\"", word, word_.substr(0, 40)));
  }
  std::string string() {
    const std::string result(word_);
    taken_ = place_;
    if (at_end())
      refuse("the file ends too early");
    else
      next();
    return result;
  }
  float number() {
    const std::string word = string();
    const auto value = failed() ? std::nullopt : parse_number(word);
    if (!failed() && (!value || !std::isfinite(static_cast<float>(*value))))
      refuse(fmt::format("a number is wanted, not \"{}\"", word.substr(0, 40)));
    return failed() || !value ? 0.0f : static_cast<float>(*value);
  }
  // A whole number from `least` to `most`.
  std::int64_t whole(std::string_view what, std::int64_t least, std::int64_t most) {
    const std::string word = string();
    const auto value = failed() ? std::nullopt : parse_number(word);
    if (failed()) return least;
    const bool fits = value && *value == std::floor(*value) && *value >= static_cast<double>(least) &&
                      *value <= static_cast<double>(most);
    if (!fits) refuse(fmt::format("{} is \"{}\", not from {} to {}", what, word.substr(0, 40), least, most));
    return fits ? static_cast<std::int64_t>(*value) : least;
  }
  std::uint32_t index(std::string_view what, std::uint32_t count) {
    return static_cast<std::uint32_t>(whole(what, 0, std::int64_t{count} - 1));
  }
  std::uint32_t count(std::string_view name, std::uint32_t most) {
    expect(name);
    return static_cast<std::uint32_t>(whole(name, 1, most));
  }
  vec3 vector() {
    expect("(");
    vec3 v;
    for (int axis = 0; axis < 3; ++axis) v[axis] = number();
    expect(")");
    return v;
  }
  // What is left to read bounds what is worth allocating: no element takes less than two bytes.
  bool holds(std::uint32_t count) {
    if (count <= text_.size() / 2 + 1) return true;
    refuse(fmt::format("{} are said, more than the file holds", count));
    return false;
  }

 private:
  void skip_blanks() {
    while (!text_.empty()) {
      if (text_.starts_with("//")) {
        text_.remove_prefix(std::min(text_.find('\n'), text_.size()));
      } else if (static_cast<unsigned char>(text_[0]) <= ' ') {
        line_ += text_[0] == '\n' ? 1 : 0;
        text_.remove_prefix(1);
      } else {
        return;
      }
    }
  }
  void next() {
    skip_blanks();
    place_ = {size_ - text_.size(), line_};
    quoted_ = !text_.empty() && text_[0] == '"';
    if (quoted_) {
      text_.remove_prefix(1);
      const std::size_t end = std::min(text_.find('"'), text_.size());
      word_ = text_.substr(0, end);
      text_.remove_prefix(std::min(end + 1, text_.size()));
      return;
    }
    const bool sign = !text_.empty() && kSigns.find(text_[0]) != kSigns.npos;
    std::size_t end = sign ? 1 : 0;
    while (!sign && end < text_.size() && static_cast<unsigned char>(text_[end]) > ' ' && text_[end] != '"' &&
           kSigns.find(text_[end]) == kSigns.npos)
      ++end;
    word_ = text_.substr(0, end);
    text_.remove_prefix(end);
  }

  static constexpr std::string_view kSigns = "(){}";
  struct Place {
    std::size_t offset = 0;
    int line = 1;
  };
  std::size_t size_;
  std::string_view text_, name_, word_;
  bool quoted_ = false;
  int line_ = 1;
  Place place_, taken_;  // of the word; of that which a message is about
  std::optional<Error> error_;
};

struct Joint {
  std::int32_t parent = -1;  // an earlier one
  vec3 place{0.0f};
  glm::quat turn{1.0f, 0.0f, 0.0f, 0.0f};
};

struct Weight {
  std::uint32_t joint;
  float share;
  vec3 place;  // in the joint's space
};

struct WeightRange {
  std::uint32_t first, count;
};

struct SkinnedMesh {
  std::vector<Joint> joints;
  std::vector<std::string> names;  // theirs
  std::vector<Weight> weights;
  std::vector<WeightRange> ranges;  // one a vertex
};

// Three numbers stand for a unit quaternion whose fourth is not above zero.
glm::quat quaternion(const vec3& xyz) {
  const float rest = 1.0f - glm::dot(xyz, xyz);
  return glm::normalize(glm::quat(rest > 0.0f ? -std::sqrt(rest) : 0.0f, xyz.x, xyz.y, xyz.z));
}

glm::quat read_quaternion(Words& words) {
  const glm::quat q = quaternion(words.vector());
  const bool finite = std::isfinite(q.w) && std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z);
  if (!finite) words.refuse("an orientation is none");
  return finite ? q : glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
}

void read_header(Words& words) {
  words.expect("MD5Version");
  words.whole("the version", 10, 10);
  if (words.take("commandline")) words.string();
}

void read_joints(Words& words, std::uint32_t count, SkinnedMesh& skinned) {
  words.expect("joints");
  words.expect("{");
  for (std::uint32_t i = 0; i < count && !words.failed(); ++i) {
    skinned.names.push_back(words.string());
    Joint joint;
    joint.parent = static_cast<std::int32_t>(words.whole("a joint's parent", -1, std::int64_t{i} - 1));
    joint.place = words.vector();
    joint.turn = read_quaternion(words);
    skinned.joints.push_back(joint);
  }
  words.expect("}");
}

void read_vertices(Words& words, PosedModel& model, SkinnedMesh& skinned, std::uint32_t first_weight) {
  const std::uint32_t count = words.count("numverts", kMost);
  if (!words.holds(count)) return;
  for (std::uint32_t i = 0; i < count && !words.failed(); ++i) {
    words.expect("vert");
    words.whole("a vertex's number", i, i);
    words.expect("(");
    vec2 uv;
    uv.x = words.number();
    uv.y = words.number();
    words.expect(")");
    const std::uint32_t first = words.index("a vertex's first weight", kMost);
    const auto weights = static_cast<std::uint32_t>(words.whole("a vertex's number of weights", 1, kMostWeights));
    model.uv.push_back(uv);
    skinned.ranges.push_back({first_weight + first, weights});
  }
}

void read_surface(Words& words, PosedModel& model, SkinnedMesh& skinned) {
  const auto first_vertex = static_cast<std::uint32_t>(model.uv.size());
  const auto first_weight = static_cast<std::uint32_t>(skinned.weights.size());
  PosedSurface surface;
  words.expect("{");
  if (words.take("shader")) surface.shader = words.string();
  read_vertices(words, model, skinned, first_weight);
  const auto vertices = static_cast<std::uint32_t>(model.uv.size()) - first_vertex;
  const std::uint32_t triangles = words.count("numtris", kMost);
  if (!words.holds(triangles)) return;
  for (std::uint32_t i = 0; i < triangles && !words.failed(); ++i) {
    words.expect("tri");
    words.whole("a triangle's number", i, i);
    std::array<std::uint32_t, 3> corners;
    for (std::uint32_t& corner : corners) corner = first_vertex + words.index("a triangle's vertex", vertices);
    surface.triangles.push_back(corners);
  }
  const std::uint32_t weights = words.count("numweights", kMost);
  if (!words.holds(weights)) return;
  for (std::uint32_t i = 0; i < weights && !words.failed(); ++i) {
    words.expect("weight");
    words.whole("a weight's number", i, i);
    Weight weight;
    weight.joint = words.index("a weight's joint", static_cast<std::uint32_t>(skinned.joints.size()));
    weight.share = words.number();
    weight.place = words.vector();
    skinned.weights.push_back(weight);
  }
  words.expect("}");
  for (std::size_t v = first_vertex; v < skinned.ranges.size() && !words.failed(); ++v) {
    const WeightRange& range = skinned.ranges[v];
    if (std::size_t{range.first} + range.count > skinned.weights.size())
      words.refuse(fmt::format("vertex {} has weights that are not there", v - first_vertex));
  }
  model.surfaces.push_back(std::move(surface));
}

void read_mesh(Words& words, PosedModel& model, SkinnedMesh& skinned) {
  read_header(words);
  const std::uint32_t joints = words.count("numJoints", kMostJoints), meshes = words.count("numMeshes", kMost);
  read_joints(words, joints, skinned);
  for (std::uint32_t i = 0; i < meshes && !words.failed(); ++i) {
    words.expect("mesh");
    read_surface(words, model, skinned);
  }
}

// One pose more, with the joints in the model's space. Refuses what leaves a float's range.
bool add_pose(PosedModel& model, const SkinnedMesh& skinned, const std::vector<Joint>& joints) {
  for (const WeightRange& range : skinned.ranges) {
    vec3 sum(0.0f);
    for (std::uint32_t w = range.first; w < range.first + range.count; ++w) {
      const Weight& weight = skinned.weights[w];
      const Joint& joint = joints[weight.joint];
      sum += weight.share * (joint.place + joint.turn * weight.place);
    }
    if (!std::isfinite(sum.x) || !std::isfinite(sum.y) || !std::isfinite(sum.z)) return false;
    model.positions.push_back(sum);
  }
  ++model.pose_count;
  model.pose_names.emplace_back();
  return true;
}

// What a frame says of a joint: which of its six components, from which of the frame's numbers on.
struct Track {
  std::uint32_t components, first;
};

class Animation {
 public:
  Animation(Words& words, const SkinnedMesh& bound) : words_(words) {
    read_header(words_);
    frames_ = words_.count("numFrames", kMost);
    if (!words_.failed() && frames_ > kMostPosedVertices / bound.ranges.size())
      words_.refuse(fmt::format("{} frames of {} vertices are too much", frames_, bound.ranges.size()));
    const std::uint32_t joints = words_.count("numJoints", kMostJoints);
    words_.expect("frameRate");
    words_.number();
    words_.expect("numAnimatedComponents");
    numbers_ = static_cast<std::uint32_t>(words_.whole("numAnimatedComponents", 0, kMostJoints * kComponents));
    if (!words_.failed() && joints != bound.joints.size())
      words_.refuse(fmt::format("it has {} joints, its mesh {}", joints, bound.joints.size()));
    if (!words_.failed() && std::uint64_t{frames_} * joints > kMostJointPoses)
      words_.refuse(fmt::format("{} frames of {} joints are too much", frames_, joints));
    read_hierarchy(joints, bound);
    read_bounds();
    read_base(joints);
  }

  std::uint32_t frames() const { return frames_; }

  // The next frame's joints in the model's space, in the mesh's order.
  std::vector<Joint> frame(std::uint32_t number) {
    words_.expect("frame");
    words_.whole("a frame's number", number, number);
    words_.expect("{");
    std::vector<float> values;
    for (std::uint32_t i = 0; i < numbers_ && !words_.failed(); ++i) values.push_back(words_.number());
    words_.expect("}");
    std::vector<Joint> joints = base_;
    for (std::size_t j = 0; j < joints.size() && !words_.failed(); ++j) place(joints, j, values);
    std::vector<Joint> ordered(joints.size());
    for (std::size_t j = 0; j < joints.size() && !words_.failed(); ++j) ordered[order_[j]] = joints[j];
    return ordered;
  }

 private:
  void read_hierarchy(std::uint32_t joints, const SkinnedMesh& bound) {
    std::vector<std::string> names;
    words_.expect("hierarchy");
    words_.expect("{");
    for (std::uint32_t j = 0; j < joints && !words_.failed(); ++j) {
      names.push_back(words_.string());
      Joint joint;
      joint.parent = static_cast<std::int32_t>(words_.whole("a joint's parent", -1, std::int64_t{j} - 1));
      const auto components = static_cast<std::uint32_t>(words_.whole("a joint's components", 0, 63));
      const auto first = static_cast<std::uint32_t>(words_.whole("a joint's first number", 0, kMost));
      const auto count = static_cast<std::uint32_t>(std::popcount(components));
      if (!words_.failed() && count > 0 && first + count > numbers_)
        words_.refuse("a joint has numbers that are not there");
      tracks_.push_back({components, first});
      base_.push_back(joint);
    }
    words_.expect("}");
    find_order(names, bound.names);
  }
  // Joints are the mesh's by their names; where names do not tell, by their order.
  void find_order(const std::vector<std::string>& names, const std::vector<std::string>& wanted) {
    std::map<std::string_view, std::uint32_t> index;
    for (std::size_t j = 0; j < wanted.size(); ++j) index.emplace(wanted[j], static_cast<std::uint32_t>(j));
    std::vector<bool> taken(wanted.size(), false);
    for (const std::string& name : names) {
      const auto found = index.find(name);
      if (found == index.end() || taken[found->second]) break;
      taken[found->second] = true;
      order_.push_back(found->second);
    }
    if (order_.size() == names.size()) return;
    order_.resize(names.size());
    std::iota(order_.begin(), order_.end(), 0u);
  }
  void read_bounds() {
    words_.expect("bounds");
    words_.expect("{");
    for (std::uint32_t i = 0; i < frames_ && !words_.failed(); ++i) {
      words_.vector();
      words_.vector();
    }
    words_.expect("}");
  }
  void read_base(std::uint32_t joints) {
    words_.expect("baseframe");
    words_.expect("{");
    for (std::uint32_t j = 0; j < joints && !words_.failed(); ++j) {
      base_[j].place = words_.vector();
      turns_.push_back(words_.vector());
    }
    words_.expect("}");
  }
  // From its parent's space, which an earlier joint has, to the model's.
  void place(std::vector<Joint>& joints, std::size_t j, const std::vector<float>& values) const {
    Joint& joint = joints[j];
    vec3 turn = turns_[j];
    std::size_t from = tracks_[j].first;
    for (int c = 0; c < kComponents; ++c) {
      if ((tracks_[j].components >> c & 1u) == 0) continue;
      (c < 3 ? joint.place[c] : turn[c - 3]) = values[from++];
    }
    joint.turn = quaternion(turn);
    if (joint.parent < 0) return;
    const Joint& parent = joints[static_cast<std::size_t>(joint.parent)];
    joint.place = parent.place + parent.turn * joint.place;
    joint.turn = glm::normalize(parent.turn * joint.turn);
  }

  Words& words_;
  std::uint32_t frames_ = 0, numbers_ = 0;
  std::vector<Joint> base_;           // places in their parents' space
  std::vector<vec3> turns_;           // of the base frame
  std::vector<Track> tracks_;         // one a joint
  std::vector<std::uint32_t> order_;  // a joint's number in the mesh
};

std::optional<Error> animate(PosedModel& model, const SkinnedMesh& skinned, const Md5Text& text) {
  Words words(text);
  Animation animation(words, skinned);
  for (std::uint32_t i = 0; i < animation.frames() && !words.failed(); ++i) {
    const std::vector<Joint> joints = animation.frame(i);
    if (!words.failed() && !add_pose(model, skinned, joints)) words.refuse("a vertex is nowhere");
  }
  return words.failed() ? std::optional(words.error()) : std::nullopt;
}

}  // namespace

Result<PosedModel> parse_md5(const Md5Text& mesh, const std::optional<Md5Text>& anim) {
  PosedModel model;
  SkinnedMesh skinned;
  Words words(mesh);
  read_mesh(words, model, skinned);
  if (words.failed()) return words.error();
  model.vertex_count = static_cast<std::uint32_t>(model.uv.size());
  if (anim) {
    if (const auto error = animate(model, skinned, *anim)) return *error;
  } else if (!add_pose(model, skinned, skinned.joints)) {
    words.refuse("a vertex is nowhere");
    return words.error();
  }
  return model;
}

}  // namespace fb::formats
