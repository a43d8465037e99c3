// Who has the keys: the menu, the message or the console that is typed, or the bindings. QuakeSpasm's rules say so.
// Wherever text is typed the same keys edit it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "console/bindings.h"
#include "console/console.h"
#include "console/input_line.h"
#include "host/game/pad_layer.h"
#include "platform/input_event.h"
#include "ui/menu/menu.h"
#include "ui/message_line.h"

namespace fb::host {

// Whether an event counts that comes while the program can't answer: what ends does, so that no key is held for ever;
// what begins would be done later, all at once.
bool counts_while_waiting(const platform::InputEvent& event);

class KeyRouter {
 public:
  // What is behind the menu and the console.
  enum class Behind {
    kNothing,  // the console fills the picture and is typed at
    kDemo,     // some keys direct it, others that print open the menu
    kGame,
  };

  // Registers toggleconsole, messagemode, messagemode2, the menus' commands and the bindings. Console and facts must
  // outlive it.
  KeyRouter(con::Console& console, ui::menu::Facts& facts);

  // Handles a key, text, motion or focus event; ignores others.
  void handle(const platform::InputEvent& happened);
  bool console_open() const { return open_; }
  bool menu_open() const { return menu_.open(); }
  // Whether a game of one player waits: all keys go elsewhere.
  bool holds_game() const { return open_ || menu_.open() || message_.open(); }
  // What directs a demo: asked first where a demo is behind, and told of every key that is let go. True: it was meant.
  void set_demo_keys(std::function<bool(const platform::InputEvent&)> demo_keys) { demo_keys_ = std::move(demo_keys); }
  // The panel, which has what it takes before the game does, and after menu, console and message. It is told of every
  // key that is let go, too.
  void set_panel(std::function<bool(const platform::InputEvent&)> panel) { panel_ = std::move(panel); }
  // Reads the text that was copied last; without one nothing is pasted.
  void set_clipboard(std::function<std::string()> clipboard) { clipboard_ = std::move(clipboard); }
  // A game has begun: the console and the menu give way.
  void close_all();
  void set_behind(Behind behind);
  // A stick moves in the menu as the arrow keys do: at once, then ever again while it is held. -1 to 1, down is
  // positive.
  void steer(const vec2& stick, double now);
  ui::menu::Menu& menu() { return menu_; }

  // Once a frame, before the menu is drawn.
  void begin_frame();
  // Before the console is drawn, which shows so many lines.
  void begin_console(std::size_t rows);

  // What is drawn of it.
  const con::InputLine& console_line() const { return input_; }
  con::InputLine& console_line() { return input_; }
  std::size_t scrolled_up() const { return scrolled_up_; }  // lines of the console
  const ui::MessageLine& message() const { return message_; }

 private:
  void register_commands();
  void toggle_console();
  void escape();
  void handle_menu(const platform::InputEvent& event);
  void handle_menu_key(int key);
  void run_binding(const platform::InputEvent& event);
  void handle_text(const std::string& text);
  bool edit(con::InputLine& line, const platform::InputEvent& event);
  void paste(con::InputLine& line);
  void type(const platform::InputEvent& event);
  void scroll(int lines);

  con::Console& console_;
  con::Bindings bindings_;
  PadLayer pad_layer_;
  con::InputLine input_;
  ui::MessageLine message_;
  ui::menu::Menu menu_;
  std::function<bool(const platform::InputEvent&)> panel_ = [](const platform::InputEvent&) { return false; };
  std::function<bool(const platform::InputEvent&)> demo_keys_ = [](const platform::InputEvent&) { return false; };
  bool open_ = false;
  bool alt_ = false, ctrl_ = false, shift_ = false;  // held
  Behind behind_ = Behind::kNothing;
  std::size_t scrolled_up_ = 0;
  std::size_t rows_ = 8;           // lines that the console shows
  std::uint64_t lines_drawn_ = 0;  // of the console in all, when it was drawn last
  std::function<std::string()> clipboard_ = [] { return std::string(); };
  ivec2 steered_{0};             // the direction of the stick in the last frame
  double steer_again_ = 0;       // when it moves again
  vec2 pointer_{0.0f};           // output pixels
  int menu_frames_ = 0;          // since the menu opened
  bool text_was_bound_ = false;  // the last key was given to a command: its letter is no text
};

}  // namespace fb::host
