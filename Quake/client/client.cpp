#include "client/client.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <new>

#include "base/log.h"
#include "base/out_of_memory.h"
#include "client/client_impl.h"
#include "client/session/interpolate.h"
#include "client/session/parse.h"
#include "client/session/sounds.h"
#include "client/sources/map_view.h"
#include "console/console.h"

namespace fb::cl {

Client::Impl::Impl(con::Console& console_, scene::ModelLibrary& library_, FileLoader files_)
    : console(console_), library(library_), files(std::move(files_)) {
  clock = [] { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); };
  session.load_world = [this](ClientState& state) { return load_world(state); };
  session.localization = &console.localization();
  session.load_model = [this](const std::string& name) { return library.map() ? &library.model(name) : nullptr; };
  session.print = [this](const std::string& text) { print(text); };
  register_console();
  register_demo_commands();
  register_game_commands();
  register_input_commands();
  register_recording_commands();
  read_settings();
}

// Whole lines go to the log, where the console sees them. Quake's coloured letters have the high bit set.
void Client::Impl::print(const std::string& text) {
  for (const char c : text) {
    if (c == '\n') {
      log_info("{}", unfinished_line);
      unfinished_line.clear();
      continue;
    }
    const char plain = static_cast<char>(static_cast<unsigned char>(c) & 0x7f);
    if (plain >= ' ' && unfinished_line.size() < 4096) unfinished_line.push_back(plain);
  }
}

Status Client::Impl::load_world(ClientState& state) {
  if (link() && !link()->is_local() && loading) loading();
  snapshots.forget();
  view_memory = {};
  sky = {};
  drift.forget();
  mouse_move = {};
  if (link()) link()->begin_level();
  if (demo()) session.reseed();
  if (const Status loaded = load_models(state); !loaded.ok()) return loaded;
  const bool has_world = state.models.size() > 1 && state.models[1] != nullptr;
  read_settings();
  if (has_world) apply_worldspawn(library.map_entities(), state.model_names[1], session.settings, state);
  if (session.quiet) return ok_status();
  if (state.model_names.size() > 1) log_info("{}", state.hud.level_name);
  if (has_world) tell_of_even_light(state.model_names[1]);
  return ok_status();
}

// The models that the state's names mean. Without a world, where none is required, there are only models of files.
Status Client::Impl::load_models(ClientState& state) {
  if (state.model_names.size() < 2) return world_required ? Status(Error{"the server names no map"}) : ok_status();
  read_settings();
  library.set_enhanced_models(session.settings.r_enhancedmodels != 0.0f);
  const Status loaded = library.load_map(state.model_names[1]);
  if (!loaded.ok()) {
    if (world_required) return loaded;
    library.clear();
  }
  loaded_level = session.levels;
  find_models(state);
  return ok_status();
}

void Client::Impl::find_models(ClientState& state) {
  for (std::size_t i = 1; i < state.model_names.size(); ++i)
    if (library.map() || i > 1) state.models[i] = &library.model(state.model_names[i]);
}

void Client::Impl::tell_of_even_light(const std::string& map) {
  read_settings();
  if (library.map_ambient().instead && session.settings.r_ambient < 0.0f)
    log_info("{} has no light, no sky and no glowing texel; it is shown in an even light (r_ambient 0: in none)", map);
}

void Client::Impl::refresh_sky() {
  ClientState& state = session.state;
  if (!state.sky_changed) return;
  state.sky_changed = false;
  sky = library.map_sky();
  if (state.skybox && !state.skybox->empty()) sky = library.make_skybox(*state.skybox, library.map_sky());
}

// What Quake does after a frame has been drawn.
void Client::Impl::finish_frame() {
  const ClientState& state = session.state;
  const double seconds = std::max(0.0, state.time - state.old_time);
  session.effects.particles.run(state.time, seconds);
  if (state.signon == kSignons) session.effects.lights.decay(state.time, seconds);
}

// Everything between the two latest messages, and how the player sees it.
void Client::Impl::show_moment(double seconds) {
  ClientState& state = session.state;
  relink(session, demo() != nullptr, timing() || (link() && link()->is_local() && in_step));
  const Entity* eye = state.view_entity_state();
  session.effects.beams.update(state.time, state.view_entity, eye ? eye->origin : vec3(0.0f));
  // A timedemo's frames are as long as the time between its messages, so that they look the same on any machine.
  frame_seconds = timing() ? std::clamp(state.time - state.old_time, 0.0, 0.1) : seconds;
  if (link()) drift_pitch(frame_seconds);
  if (!state.hud.paused || state.hud.intermission != Intermission::kNone)
    view = calculate_view(session, view_memory, library.map(), frame_seconds);
  state.view_model.frame = state.hud.stats[net::kStatWeaponFrame];
  const scene::Model* weapon = state.model(state.hud.stats[net::kStatWeapon]);
  if (weapon && weapon->kind == scene::ModelKind::kAlias)
    animate_entity(state.view_model, *weapon, state.time, animates_smoothly(session.settings, weapon->name));
  place_entities(session);
}

// Messages that are due by then, and all that moves.
void Client::Impl::step(double seconds) {
  ClientState& state = session.state;
  ++session.frame;
  finish_frame();
  state.old_time = state.time;
  if (!timing()) state.time += seconds;
  if (demo())
    read_demo();
  else
    read_server();
  if (source_has_messages()) show_moment(seconds);
}

void Client::Impl::finish_moment() {
  if (active()) refresh_sky();
  session.state.hud.time = session.state.time;
}

void Client::Impl::advance(double seconds) {
  read_settings();
  if (asked()) poll_attempt();
  start_next_time_demo();
  ClientState& state = session.state;
  frame_seconds = seconds;
  if (demo()) {
    play_demo(seconds);
  } else if (link()) {
    step(seconds);
  } else {
    ++session.frame;
    if (shows_map()) {
      state.old_time = state.time;
      state.time += seconds;
      finish_frame();
      place_entities(session);
    }
  }
  finish_moment();
  ++frame;
}

Client::Client(con::Console& console, scene::ModelLibrary& library, FileLoader files)
    : impl_(std::make_unique<Impl>(console, library, std::move(files))) {}
Client::~Client() { impl_->stop_recording(); }

Status Client::start_demo(std::string_view name, DemoMode mode) {
  const std::string path = demo_path(name);
  std::optional<FileData> data = impl_->files ? impl_->files(path) : std::nullopt;
  if (!data) {
    stop();
    return Error{fmt::format("couldn't open {}: no such file", path)};
  }
  return start_demo(std::move(*data), path, mode);
}
Status Client::start_demo(FileData data, std::string_view name, DemoMode mode) {
  impl_->time_demos.clear();
  impl_->next_time_demo = 0;
  return impl_->start(std::move(data), name, mode);
}
void Client::stop() { impl_->end_demo(std::nullopt); }

void Client::set_local_server(LocalServer local) { impl_->local = std::move(local); }
void Client::set_network(net::Network& network) { impl_->network = &network; }
void Client::set_write_path(std::function<Result<std::filesystem::path>(std::string_view)> write_path) {
  impl_->write_path = std::move(write_path);
}
void Client::set_loading(std::function<void()> loading) { impl_->loading = std::move(loading); }
void Client::connect(std::unique_ptr<net::Connection> connection, std::string server) {
  impl_->connect(std::move(connection), std::move(server));
}
Status Client::connect(std::string_view server) { return impl_->connect_to(server); }
void Client::disconnect() { impl_->disconnect(); }
bool Client::connected() const { return impl_->link() != nullptr; }
bool Client::connecting() const { return impl_->asked() != nullptr; }
bool Client::serves_itself() const { return impl_->link() && impl_->link()->is_local(); }
bool Client::recording() const { return impl_->recorder.has_value(); }
void Client::set_sticks(const Sticks& sticks) { impl_->sticks = sticks; }
float Client::take_jolt() {
  const float jolt = std::exchange(impl_->session.state.jolt, 0.0f);
  return connected() ? jolt : 0.0f;
}
bool Client::mouse_looks() const { return impl_->buttons.mouse_look.down(); }
void Client::set_in_step(bool in_step) { impl_->in_step = in_step; }
void Client::look(double seconds, const vec2& mouse) { impl_->look(seconds, mouse); }
void Client::send() { impl_->send(); }
std::optional<DemoStatus> Client::demo_status() const {
  Impl& i = *impl_;
  if (!i.demo() || i.timing()) return std::nullopt;
  const double length = i.demo()->index().seconds();
  return DemoStatus{i.control.back_to.value_or(i.demo_seconds()), length, i.control.rate(), i.control.paused};
}
bool Client::seek_demo(double seconds) { return impl_->seek_demo(seconds); }
void Client::pause_demo(bool paused) { impl_->control.paused = paused; }
bool Client::playing() const { return impl_->demo() != nullptr; }
bool Client::timing() const { return impl_->timing(); }
const std::optional<Error>& Client::last_error() const { return impl_->error; }
const std::optional<TimeDemoResult>& Client::last_time_demo() const { return impl_->time_demo; }
bool Client::more_to_time() const { return impl_->next_time_demo < impl_->time_demos.size(); }

Status Client::map_view(std::string_view name) {
  stop();
  disconnect();
  try {
    impl_->read_settings();  // it can be seen at once, before any advance
    const Status status = load_map_view(name, impl_->library, impl_->session, impl_->view);
    if (!status.ok()) return status;
    impl_->source = StillMap{};
    impl_->snapshots.forget();
    impl_->tell_of_even_light(map_path(name));
    impl_->refresh_sky();
    place_entities(impl_->session);
    return status;
  } catch (const std::bad_alloc& failure) {
    impl_->source = NoSource{};  // the former view is gone, too
    return Error{sentence_of(failure)};
  }
}

void Client::give_up(const Error& why) {
  impl_->demo_loop_next = -1;
  stop();
  disconnect();
  impl_->source = NoSource{};
  impl_->session.state.signon = 0;
  impl_->snapshots.forget();
  log_error("{}", why.message);
  impl_->error = why;
}

scene::AuthoredMap& Client::authored() { return impl_->authored; }
void Client::settle() {
  if (impl_->session.settings.r_authored != 0.0f) impl_->authored.wait();
}
std::vector<float> Client::light_style_values() const {
  std::vector<float> values;
  const ClientState& state = impl_->session.state;
  for (const std::string& style : state.light_styles) values.push_back(light_style_value(style, state.time));
  return values;
}
void Client::advance(double seconds) { impl_->advance(seconds); }
bool Client::active() const { return impl_->active(); }
void Client::set_particle_limit(std::size_t limit) { impl_->session.effects.particles.set_capacity(limit); }
void Client::set_view_size(int width, int height) {
  impl_->width = width;
  impl_->height = height;
}
void Client::set_camera(const std::optional<scene::Camera>& camera) { impl_->camera = camera; }

void Client::build_snapshot(scene::FrameSnapshot& snapshot) {
  Impl& i = *impl_;
  const SnapshotInput input{i.session, i.view,     i.library, i.active() ? i.world() : nullptr,
                            i.camera,  i.width,    i.height,  i.active(),
                            i.sky,     &i.authored};
  i.snapshots.build(input, snapshot);
}

void Client::set_sound_listener(scene::SoundListener listener) { impl_->session.sound_listener = std::move(listener); }
scene::SoundScene Client::sound_scene() const {
  const Impl& i = *impl_;
  const vec3& origin = i.camera ? i.camera->position : i.view.origin;
  const vec3& angles = i.camera ? i.camera->angles : i.view.angles;
  scene::SoundScene scene = cl::sound_scene(i.session, origin, angles, i.active() ? i.library.map() : nullptr);
  scene.seconds = i.frame_seconds;
  scene.paused |= impl_->demo() && !impl_->timing() && i.control.rate() == 0.0;
  return scene;
}

const Session& Client::session() const { return impl_->session; }
int Client::levels() const { return impl_->session.levels; }
const Hud& Client::hud() const { return impl_->session.state.hud; }
MusicTracks Client::music() const { return impl_->session.state.music; }
Fog Client::fog() const { return fog_at(impl_->session.state.fog, impl_->session.state.time); }
vec3 Client::view_angles() const { return impl_->session.state.view_angles; }
vec3 Client::player_origin() const {
  const Entity* player = impl_->session.state.view_entity_state();
  return player ? player->origin : vec3(0.0f);
}
vec3 Client::velocity() const { return impl_->session.state.velocity; }
double Client::time() const { return impl_->session.state.time; }
double Client::silence() const {
  return impl_->link() && !impl_->link()->is_local() && active() ? impl_->clock() - impl_->last_heard : 0.0;
}
int Client::protocol() const {
  return impl_->session.state.have_server_info ? impl_->session.state.protocol.version : 0;
}
const std::string& Client::demo_name() const {
  static const std::string kNone;
  return impl_->demo() ? impl_->demo()->name() : kNone;
}
std::size_t Client::messages_read() const { return impl_->demo() ? impl_->demo()->messages_read() : 0; }
void Client::set_clock(std::function<double()> clock) { impl_->clock = std::move(clock); }
void Client::set_world_required(bool required) { impl_->world_required = required; }

}  // namespace fb::cl
