// PathTechnique: one shader that traces paths, nothing kept. Techniques that keep something derive from it.
#pragma once

#include <string>
#include <string_view>

#include "render/techniques/technique.h"

namespace fb::render {

class PathTechnique : public Technique {
 public:
  explicit PathTechnique(std::string_view name) : name_(name) {}
  void prepare(const TechniqueFrame&) override {}
  void add_passes(const TechniquePasses& passes) override { add_paths_pass(passes, name_); }

 private:
  std::string name_;
};

}  // namespace fb::render
