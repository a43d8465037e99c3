// Options: the well-known page, video, sound, and every other setting.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "ui/menu/pages.h"
#include "ui/menu/rows.h"

namespace fb::ui::menu {
namespace {

// Adds a slider for a cvar, if there is one that has an effect.
void add_slider(Page& page, const con::Console& console, const char* name, const char* label, double min, double max,
                double step) {
  const con::Cvar* cvar = console.find_cvar(name);
  if (cvar && cvar->has_effect()) page.rows.push_back(setting_row(*cvar, label, slider_of(*cvar, min, max, step)));
}

void add_toggle(Page& page, const con::Console& console, const char* name, const char* label) {
  const con::Cvar* cvar = console.find_cvar(name);
  if (cvar && cvar->has_effect()) page.rows.push_back(setting_row(*cvar, label, toggle_of(*cvar)));
}

// A setting as a player calls it. What "All settings" says of it under its cvar's name is for whoever types it.
struct Named {
  const char *cvar, *label, *help;
  enum class As { kByRange, kAutomatic, kVolume } as = As::kByRange;  // kAutomatic: -1, 0 and 1
};

constexpr Named kWindowRows[] = {
    {"vid_fullscreen", "Full screen", "the picture fills the display; Apply changes it"},
    {"vid_desktopfullscreen", "Display's mode", "full screen keeps the display as it is; off: it has the size above"},
    {"vid_borderless", "No border", "the window has no frame; Apply changes it"},
    {"vid_vsync", "Vertical sync", "pictures wait for the display: no torn ones, at most its rate"},
};
constexpr Named kPictureRows[] = {
    {"r_target_ms", "Time of a frame",
     "milliseconds; as many pixels are drawn as fit. 0: all, however long; -1: 100 without a GPU, else all"},
    {"r_scale", "Resolution", "width and height of what is drawn, of the window's; the rest is filled in over time"},
    {"r_cpu_pixels", "Most pixels", "without a GPU no more pixels than these are drawn; 0: all"},
    {"r_spp", "Light samples", "paths of light a pixel: more is slower and less noisy"},
    {"r_bounces", "Reflections",
     "how often light goes on from surface to surface: more is slower and brighter in corners"},
    {"r_water", "Clear water", "water reflects, bends and takes light; off: Quake's; automatic: on with a GPU",
     Named::As::kAutomatic},
    {"r_fog_scale", "Fog's resolution", "of the light in fog: less is faster and softer"},
    {"r_denoise", "Noise filter", "makes a few samples a smooth picture", Named::As::kAutomatic},
    {"r_taa", "Smooth over time", "edges get smooth over several pictures"},
    {"r_fxaa", "Smooth edges", "of each picture by itself, where it is not smoothed over time"},
    {"host_maxfps", "Frame rate limit", "above 72 movement between the game's steps is shown"},
    {"r_frames_ahead", "A frame ahead",
     "more frames a second, but keys and mouse show one picture later; automatic: in demos", Named::As::kAutomatic},
    {"scr_showfps", "Show frame rate", "frames a second, in a corner"},
    {"scr_menuscale", "Size of menus", "of menus, messages and scoreboards"},
};
constexpr Named kSoundRows[] = {
    {"volume", "Sound volume", "of all but the music", Named::As::kVolume},
    {"bgmvolume", "Music volume", "of the music", Named::As::kVolume},
    {"bgm_extmusic", "Music from files", "plays the music that lies in the game's folder"},
    {"ambient_level", "Water and wind", "volume of the sounds of water and sky about you"},
    {"snd_waterfx", "Muffled under water", "how much sounds are dulled there; 0: not at all"},
    {"snd_mute_unfocused", "Silent in background", "no sound while another window is in front"},
    {"snd_filterquality", "Sound quality", "of sounds recorded at other rates: higher is clearer"},
    {"nosound", "No new sounds", "sounds are off; the music plays on"},
};

Control named_control(const con::Cvar& cvar, Named::As as) {
  if (as == Named::As::kVolume) return slider_of(cvar, 0, 1, 0.1);
  if (as == Named::As::kAutomatic) return choice_of(cvar, {{"-1", "automatic"}, {"0", "off"}, {"1", "on"}});
  return control_of(cvar);
}

void add_named(Page& page, const con::Console& console, const Named& named) {
  const con::Cvar* cvar = console.find_cvar(named.cvar);
  if (!cvar || !cvar->has_effect()) return;
  Control control = named_control(*cvar, named.as);
  Control standard = control;
  standard.read = [cvar] { return std::string(cvar->default_string()); };
  Row row = setting_row(*cvar, named.label, std::move(control));
  row.help = fmt::format("{}\ndefault {}", named.help, standard.shown());
  page.rows.push_back(std::move(row));
}

// The sign of m_pitch.
Row invert_row(const con::Cvar& pitch) {
  Control control;
  control.kind = Control::Kind::kToggle;
  control.read = [&pitch] { return std::string(pitch.value() < 0.0f ? "1" : "0"); };
  control.command = [&pitch](std::string_view value) {
    const float size = std::abs(pitch.value());
    return fmt::format("m_pitch {}", con::number_text(value == "0" ? size : -size));
  };
  control.default_value = "0";
  Row row = setting_row(pitch, "Invert mouse", std::move(control));
  row.help = "m_pitch: the mouse's motion away from you looks down instead of up\ndefault off";
  return row;
}

// Mouse look is a button that is held down.
Row mouse_look_row(const Facts& facts) {
  Row row;
  row.kind = Row::Kind::kSetting;
  row.label = "Mouse look";
  row.help = "+mlook: the mouse looks up and down\ndefault on";
  Control control;
  control.kind = Control::Kind::kToggle;
  control.read = [&facts] { return std::string(facts.mouse_look() ? "1" : "0"); };
  control.command = [](std::string_view value) { return std::string(value == "0" ? "-mlook" : "+mlook"); };
  control.default_value = "1";
  row.control = std::move(control);
  return row;
}

Row preset_row(const Facts& facts) {
  Row row;
  row.kind = Row::Kind::kSetting;
  row.label = "Preset";
  Control control;
  control.kind = Control::Kind::kChoice;
  control.read = [&facts] { return facts.preset(); };
  control.command = [](std::string_view value) { return fmt::format("preset {}", value); };
  std::string help = "all of the picture's settings at once";
  for (const PresetEntry& preset : facts.presets()) {
    control.choices.push_back({preset.name, preset.name});
    help += fmt::format("\n{}: {}", preset.name, preset.purpose);
  }
  if (facts.preset().empty()) control.choices.push_back({"", "your own"});
  row.control = std::move(control);
  row.help = std::move(help);
  return row;
}

}  // namespace

Page options_page(const Sources& sources) {
  const con::Console& console = sources.console;
  Page page;
  page.title = "Options";
  page.title_picture = "gfx/p_option.lmp";
  page.rows = {link("Keys", "keys"), link("Video", "video"), link("Sound", "sound"),
               link("All settings", "settings", "every setting that is kept, by groups; type to search"),
               action("Go to console", "toggleconsole")};
  page.rows.back().closes = true;
  Row reset = action("Reset to defaults", "exec default.cfg; resetcfg");
  reset.question = "Set all keys and settings to their defaults?";
  page.rows.push_back(std::move(reset));
  add_slider(page, console, "viewsize", "Screen size", 30, 120, 10);
  add_slider(page, console, "r_exposure", "Brightness", 0.2, 3, 0.1);
  add_slider(page, console, "sensitivity", "Mouse speed", 1, 11, 0.5);
  add_slider(page, console, "volume", "Sound volume", 0, 1, 0.1);
  add_slider(page, console, "bgmvolume", "Music volume", 0, 1, 0.1);
  add_slider(page, console, "fov", "Field of view", 50, 130, 5);
  add_toggle(page, console, "cl_alwaysrun", "Always run");
  if (const con::Cvar* pitch = console.find_cvar("m_pitch")) page.rows.push_back(invert_row(*pitch));
  page.rows.push_back(mouse_look_row(sources.facts));
  add_toggle(page, console, "lookspring", "Lookspring");
  add_toggle(page, console, "lookstrafe", "Lookstrafe");
  add_toggle(page, console, "joy_enable", "Use game pad");
  page.value_column = 0.5f;
  return page;
}

Page video_page(const Sources& sources) {
  const con::Console& console = sources.console;
  Page page;
  page.title = "Video";
  page.title_picture = "gfx/vidmodes.lmp";
  page.plaque = false;
  const con::Cvar* width = console.find_cvar("vid_width");
  const con::Cvar* height = console.find_cvar("vid_height");
  if (width && height && width->has_effect()) {
    Control control;
    control.kind = Control::Kind::kChoice;
    control.read = [width, height] { return fmt::format("{} {}", width->string(), height->string()); };
    control.command = [](std::string_view value) {
      const std::string size(value);
      const std::size_t space = size.find(' ');
      return fmt::format("vid_width {}; vid_height {}", size.substr(0, space), size.substr(space + 1));
    };
    for (const uvec2& size : sources.facts.video_sizes())
      control.choices.push_back({fmt::format("{} {}", size.x, size.y), fmt::format("{}x{}", size.x, size.y)});
    control.default_value = fmt::format("{} {}", width->default_string(), height->default_string());
    Row row = setting_row(*width, "Window size", std::move(control));
    row.help = "size of the window, pixels; Apply changes it";
    page.rows.push_back(std::move(row));
  }
  for (const Named& named : kWindowRows) add_named(page, console, named);
  page.rows.push_back(action("Apply", "vid_restart", "changes the window now"));
  page.rows.push_back(heading(""));
  page.rows.push_back(preset_row(sources.facts));
  for (const Named& named : kPictureRows) add_named(page, console, named);
  page.rows.push_back(link("More of the picture", "settings/Picture"));
  page.value_column = 0.52f;
  return page;
}

Page sound_page(const Sources& sources) {
  const con::Console& console = sources.console;
  Page page;
  page.title = "Sound";
  page.plaque = false;
  page.value_column = 0.58f;
  for (const Named& named : kSoundRows) add_named(page, console, named);
  if (!page.rows.empty()) page.rows.push_back(link("More of the sound", "settings/Sound"));
  page.empty = "There is no sound.";
  return page;
}

Page settings_page(const Sources& sources) {
  Page page;
  page.title = "Settings";
  page.plaque = false;
  page.search_page = "settings/all";
  page.rows.push_back(link("All, to search by typing", "settings/all"));
  page.rows.push_back(heading(""));
  for (const std::string& group : setting_groups(sources.console)) {
    Row row = link(group, "settings/" + group);
    row.value = std::to_string(setting_rows(sources.console, group).size());
    page.rows.push_back(std::move(row));
  }
  page.value_column = 0.7f;
  return page;
}

Page all_settings_page(const Sources& sources) {
  Page page;
  page.title = "Settings";
  page.plaque = false;
  page.searchable = true;
  page.value_column = 0.56f;
  page.rows = setting_rows(sources.console, "");
  return page;
}

}  // namespace fb::ui::menu
