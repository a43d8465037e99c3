#include "host/game/engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "base/log.h"
#include "base/log_budget.h"
#include "console/other_engines.h"
#include "console/quakespasm_cvars.h"
#include "fs/path.h"
#include "host/game/file_commands.h"
#include "host/game/language.h"
#include "host/game/light_store.h"
#include "host/game/mod_check.h"
#include "render/passes/settings.h"

namespace fb::host {

EngineOptions engine_options(const GameOptions& options) {
  EngineOptions engine;
  engine.max_clients = options.max_clients;
  engine.port = static_cast<std::uint16_t>(options.port);
  engine.seed = options.seed.value_or(std::random_device{}());
  engine.network = options.network;
  engine.protocol = options.protocol;
  engine.console_log = options.console_log;
  engine.console_kilobytes = options.console_kilobytes;
  engine.particles = options.particles;
  engine.autosaves = !options.headless;
  return engine;
}

Result<std::unique_ptr<Engine>> Engine::create(const std::vector<std::string>& arguments, const EngineOptions& wanted) {
  auto options = fs::options_from_arguments(arguments);
  if (!options) return options.error();
  auto files = fs::FileSystem::open(*options);
  if (!files) return files.error();
  std::unique_ptr<Engine> engine(new Engine(std::move(*files), wanted, arguments));
  if (wanted.server && (wanted.dedicated || wanted.max_clients > 1)) {
    if (auto status = engine->listen(); !status) {
      if (wanted.dedicated) return status.error();
      log_error("{}; nobody can join", status.error().message);
    }
  }
  return engine;
}

Engine::Engine(fs::FileSystem files, const EngineOptions& options, const std::vector<std::string>& arguments)
    : files_(std::move(files)),
      library_(files_.loader(), [this](std::string_view path) { return files_.game_index_of(path); }),
      rng_(options.seed),
      network_(net::system_network(options.network)),
      server_list_(console_, *network_),
      mod_installer_(console_, files_),
      port_(options.port),
      network_on_(options.network.any()) {
  library_.set_own_files([this](std::string_view path) { return files_.is_of_base_game(path); });
  if (options.console_log) open_log();
  if (options.console_kilobytes) console_.scrollback().set_max_bytes(std::size_t{*options.console_kilobytes} * 1024);
  console_.set_file_loader(files_.loader());
  register_language(console_, files_);
  console_.add_cvar({"net_messagetimeout", "300", "seconds without a packet after which a new connection times out",
                     con::kCvarPlain, 1.0f, 86400.0f});
  console_.add_cvar({"sv_maxperhost", "8",
                     "players that may come from one address, several of a network behind one router; 0: any number",
                     con::kCvarPlain, 0.0f, 16.0f});
  register_time_cvars(console_);
  if (options.server) {
    make_server(options);
    register_listen();
    register_modcheck(console_, files_, *server_);
  }
  if (options.client) make_client();
  console_.add_command("writeconfig",
                       "writeconfig <file>: write the bindings and the settings that are kept as FILE.cfg",
                       [this](const con::Args& args) {
                         if (args.size() != 2) return log_info("writeconfig <file>: write bindings and settings");
                         const bool named = fs::ends_with_ignoring_case(args[1], ".cfg");
                         const std::string name = named ? args[1] : args[1] + ".cfg";
                         const Status status = write_config(name);
                         if (!status) return console_.fail_unless(status);
                         log_info("wrote {}", name);
                       });
  register_file_commands(console_, files_);
  console_.add_cvar("cmdline", fmt::format("{}", fmt::join(arguments, " ")), "the program's command line",
                    con::kCvarRom);
  con::add_quakespasm_cvars(console_);
  con::add_other_engines(console_);
  if (options.protocol && options.server) console_.set("sv_protocol", std::to_string(*options.protocol));
  if (options.particles && options.client) client_->set_particle_limit(*options.particles);
}

// A log that cannot be written is no reason not to play.
void Engine::open_log() {
  const auto path = files_.write_path("qconsole.log");
  auto log = path ? ConsoleLog::open(*path) : Result<std::unique_ptr<ConsoleLog>>(path.error());
  if (!log) return log_error("{}", log.error().message);
  log_ = std::move(*log);
}

Engine::~Engine() {
  if (client_) client_->disconnect();  // ends a recording, too
}

ui::Rules Engine::rules() const {
  const std::vector<std::string>& games = files_.options().games;
  const auto played = [&](const char* game) {
    return std::any_of(games.begin(), games.end(),
                       [&](const std::string& name) { return fs::lower_case(name) == game; });
  };
  if (played("hipnotic") || played("quoth")) return ui::Rules::kHipnotic;
  return played("rogue") ? ui::Rules::kRogue : ui::Rules::kQuake;
}

void Engine::make_server(const EngineOptions& options) {
  sv::ServerServices services;
  services.read_file = files_.loader();
  services.read_save = [this](std::string_view name) { return files_.read_own(name); };
  services.obstacle = [this](std::string_view name) { return files_.obstacle(name); };
  services.game_index_of = [this](std::string_view name) { return files_.game_index_of(name); };
  services.game = [this] { return files_.game(); };
  services.write_file = [this](std::string_view name, ByteView data) { return files_.write(name, data); };
  services.read_for_mod = [this](std::string_view name) { return mod_files_.read(name); };
  services.write_for_mod = [this](std::string_view name, ByteView data) { return mod_files_.write(name, data); };
  services.flush_for_mod = [this] { mod_files_.flush(); };
  services.rng = &rng_;
  sv::ServerOptions server;
  server.max_clients = options.max_clients;
  server.dedicated = options.dedicated;
  server.autosaves = options.autosaves;
  server.standard_quake = rules() == ui::Rules::kQuake;
  server_ = std::make_unique<sv::Server>(console_, std::move(services), server);
  server_->clients().add_listener(loopback_);
  if (options.max_clients > 1) console_.set("deathmatch", "1");  // as in Quake, unless the configuration says coop
}

void Engine::make_client() {
  render::register_render_cvars(console_);
  client_ = std::make_unique<cl::Client>(console_, library_, files_.loader());
  sound_ = std::make_unique<audio::SoundSystem>(console_, files_.loader(),
                                                [this](std::string_view path) { return files_.game_index_of(path); });
  client_->set_sound_listener([this](const scene::SoundEvent& event) { sound_->hear(event); });
  client_->set_network(*network_);
  client_->set_write_path([this](std::string_view name) { return files_.write_path(name); });
  if (!server_) return;
  client_->authored().set_store(light_store(files_));  // the game's: a measurement finds light anew
  client_->set_local_server(
      {[this]() -> std::unique_ptr<net::Connection> { return server_->active() ? loopback_.connect(now_) : nullptr; },
       [this] { server_->shutdown(); }});
  server_->set_local_start([this] { console_.fail_unless(client_->connect("local")); });
}

Status Engine::listen() {
  if (listener_) return ok_status();
  if (!network_on_) {
    log_info("Nobody can join: the command line has switched the network off.");
    return ok_status();
  }
  auto opened = net::DatagramListener::open(
      *network_, port_, [this] { return server_->clients().status(now_); }, std::random_device{}());
  if (!opened) return opened.error();
  listener_ = std::move(*opened);
  server_->clients().add_listener(*listener_);
  log_info("Listening at port {}.", listener_->port());
  return ok_status();
}

void Engine::set_loading(const std::function<void()>& loading) {
  if (server_) server_->set_loading(loading);
  if (client_) client_->set_loading(loading);
}

void Engine::stop_listening() {
  if (!listener_) return;
  server_->clients().remove_listener(*listener_);
  listener_.reset();
}

void Engine::register_listen() {
  console_.add_command("listen", "listen [0|1]: whether others may join over the network; maxplayers sets how many",
                       [this](const con::Args& args) {
                         if (args.size() != 2) return log_info("listen is {}", listener_ ? 1 : 0);
                         if (args.integer(1) == 0) return stop_listening();
                         console_.fail_unless(listen());
                       });
}

void Engine::queue_configuration(const GameOptions& options) {
  console_.set_command_line(options.arguments);
  console_.append(options.carried.session);
  if (files_.exists("quake.rc")) {
    console_.append("exec quake.rc\n");
  } else {
    for (const char* script : {"default.cfg", "config.cfg", "autoexec.cfg"}) {
      if (files_.exists(script)) console_.append(fmt::format("exec {}\n", script));
    }
    console_.append("stuffcmds\n");
  }
  console_.append(options.carried.commands);
}

Status Engine::write_config(std::string_view name) const {
  const auto path = files_.write_path(name);
  return path ? console_.write_config(*path) : Status(path.error());
}

std::filesystem::path Engine::history_file() const {
  const fs::FsOptions& options = files_.options();
  const auto user = options.user_dir ? *options.user_dir : fs::default_user_dir();
  return (user.empty() ? options.base_dir : user) / "history.txt";
}

void Engine::execute_commands(double now) {
  now_ = now;
  console_.set_time(now);
  if (!console_.waiting() || ticked_) console_.execute();
}

void Engine::frame(const FramePlan& plan, const vec2& mouse, double now) {
  advance_log_time(std::max({now - now_, plan.seconds, plan.ticks * plan.tick_seconds, 0.0}));
  now_ = now;
  server_list_.poll(now);
  mod_installer_.poll();
  if (listener_) {
    listener_->set_timeout(static_cast<double>(console_.cvar("net_messagetimeout").value()));
    listener_->set_most_per_host(console_.cvar("sv_maxperhost").integer());
  }
  if (client_) {
    client_->set_in_step(plan.in_step);
    client_->look(plan.seconds, mouse);
  }
  for (int i = 0; i < plan.ticks; ++i) {
    if (client_) client_->send();
    if (server_) server_->frame(plan.tick_seconds, now);
  }
  ticked_ = plan.ticks > 0;
  if (client_) client_->advance(plan.seconds);
}

bool Engine::busy() {
  if (!console_.buffer_empty() || server_list_.searching() || mod_installer_.busy()) return true;
  if (server_ && server_->active()) return true;
  return client_ && (client_->playing() || client_->more_to_time() || client_->connected() || client_->connecting());
}

bool Engine::playing() const {
  return (server_ && server_->active()) ||
         (client_ && (client_->active() || client_->playing() || client_->connected() || client_->connecting()));
}

void Engine::give_up(const Error& why) {
  if (client_) client_->give_up(why);
  if (server_) server_->shutdown();
}

bool Engine::went_wrong() const {
  return console_.failed() || (client_ && client_->last_error()) || (server_ && server_->last_error());
}

}  // namespace fb::host
