// What the menus are told of the engine.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/game/engine.h"
#include "host/game/map_list.h"
#include "ui/menu/facts.h"

namespace fb::host {

class MenuFacts final : public ui::menu::Facts {
 public:
  // The engine must outlive it.
  explicit MenuFacts(Engine& engine) : engine_(engine), maps_(engine.files()) {}
  void set_display_size(std::function<uvec2()> size) { display_size_ = std::move(size); }
  // Reads all titles in one frame: nobody waits for it, and every frame is to show the same at every run.
  void set_reads_at_once(bool at_once) { reads_at_once_ = at_once; }
  // Once a frame while the menu is open: reads a few more titles, notes what servers have answered.
  void update();

  bool in_game() const override;
  std::string reason_not_to_save() const override;
  std::vector<ui::menu::SaveEntry> saves() override;
  std::optional<formats::RgbaImage> save_picture(const std::string& name) override;
  std::string save_after_death() const override { return engine_.server().save_after_death(); }
  std::vector<ui::menu::MapEntry> maps() override { return maps_.maps(); }
  std::vector<ui::menu::MapEntry> start_maps() override { return maps_.start_maps(); }
  std::vector<std::string> demos() override;
  std::vector<ui::menu::ModEntry> mods() override;
  std::vector<ui::menu::ArchiveEntry> archives() override { return engine_.mod_installer().archives(); }
  ui::menu::InstallState installing() const override { return engine_.mod_installer().state(); }
  std::vector<ui::menu::ServerEntry> servers() override;
  bool searching_servers() const override { return engine_.server_list().searching(); }
  std::vector<uvec2> video_sizes() override;
  std::vector<ui::menu::PresetEntry> presets() const override;
  std::string preset() const override;
  bool mouse_look() const override { return engine_.client().mouse_looks(); }
  std::string key_name(int key) const override;
  std::string version() const override;
  std::uint64_t revision() const override { return revision_; }

 private:
  Engine& engine_;
  MapList maps_;
  std::function<uvec2()> display_size_;
  std::uint64_t revision_ = 1;
  std::uint64_t installs_ = 0;
  std::size_t servers_ = 0;
  bool searching_ = false, reads_at_once_ = false;
};

}  // namespace fb::host
