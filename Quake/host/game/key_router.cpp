#include "host/game/key_router.h"

#include <algorithm>

#include "base/log.h"
#include "console/quake_letters.h"
#include "platform/keys.h"

namespace fb::host {
namespace {

constexpr int kKeyGrave = '`';
constexpr int kKeyPanel = platform::kKeyF1 + 7;  // F8, where nothing is bound to it
constexpr int kAllLines = 1 << 30;
constexpr int kScrolledLines = 2, kLinesOfAPageKept = 4;  // QuakeSpasm's
// The pointer jumps to where it was when the game lets it go: that selects nothing.
constexpr int kPointerFrames = 3;
constexpr float kSteer = 0.6f;                            // of a stick's way
constexpr double kSteerDelay = 0.4, kSteerRepeat = 0.12;  // seconds

bool is_function_key(int key) { return key >= platform::kKeyF1 && key <= platform::kKeyF12; }
// Keys that open the menu over a demo.
bool starts_typing(int key) {
  return key == platform::kKeyEnter || key == platform::kKeypadEnter || key == platform::kKeyBackspace ||
         (key >= platform::kKeySpace && key < platform::kKeyBackspace && key != kKeyGrave);
}

// What a game controller's buttons do where default.cfg, as id's, knows none.
constexpr std::pair<int, const char*> kPadBindings[] = {
    {platform::kKeyRightTrigger, "+attack"},
    {platform::kKeyLeftTrigger, "+jump"},
    {platform::kKeyAButton, "+jump"},
    {platform::kKeyBButton, "+movedown"},
    {platform::kKeyXButton, "impulse 10"},
    {platform::kKeyYButton, "impulse 12"},
    {platform::kKeyRightShoulder, "impulse 10"},
    {platform::kKeyLeftShoulder, "impulse 12"},
    {platform::kKeyLeftThumb, "+speed"},
    {platform::kKeyRightThumb, "centerview"},
};

// The letter of a key together with Ctrl: as the layout has it, or, where that has no Latin one, by its place.
char shortcut(const platform::InputEvent& event) {
  const int letter = event.letter != 0 ? event.letter : event.key;
  return letter > ' ' && letter < 127 ? static_cast<char>(letter) : '\0';
}

}  // namespace

KeyRouter::KeyRouter(con::Console& console, ui::menu::Facts& facts)
    : console_(console),
      bindings_(
          console, [](std::string_view name) { return platform::key_from_name(name); },
          [](int key) { return platform::key_name(key); }),
      pad_layer_(console, bindings_),
      menu_(console, bindings_, facts) {
  register_commands();
  bindings_.bind(kKeyGrave, "toggleconsole");
  console.follow_script("default.cfg", "bindpad");
}

void KeyRouter::register_commands() {
  console_.add_command(
      "bindpad",
      "bindpad: give a game controller's buttons that have no command their usual ones; default.cfg ends with it",
      [this](const con::Args&) {
        for (const auto& [key, command] : kPadBindings)
          if (bindings_.command(key).empty()) bindings_.bind(key, command);
      });
  console_.add_command("toggleconsole", "toggleconsole: open or close the console",
                       [this](const con::Args&) { toggle_console(); });
  const auto begin_message = [this](bool to_team) {
    if (behind_ != Behind::kGame) return;
    bindings_.release_all();
    message_.begin(to_team);
  };
  console_.add_command("messagemode", "messagemode: type a message to all players",
                       [begin_message](const con::Args&) { begin_message(false); });
  console_.add_command("messagemode2", "messagemode2: type a message to your team",
                       [begin_message](const con::Args&) { begin_message(true); });
  menu_.set_opened([this] {
    open_ = false;
    scrolled_up_ = 0;
    message_.close();
    bindings_.release_all();
  });
}

void KeyRouter::close_all() {
  open_ = false;
  scrolled_up_ = 0;
  message_.close();
  menu_.close();
}

void KeyRouter::set_behind(Behind behind) {
  behind_ = behind;
  if (behind != Behind::kGame) message_.close();
}

// Without a game the console that closes leaves the main menu.
void KeyRouter::toggle_console() {
  bindings_.release_all();
  message_.close();
  menu_.close();
  open_ = !open_;
  if (!open_) {
    input_.clear();
    scrolled_up_ = 0;
  }
  if (!open_ && behind_ == Behind::kNothing) menu_.show("main");
}

void KeyRouter::escape() {
  if (menu_.capturing() || menu_.open())
    menu_.press(ui::menu::Key::kBack);
  else if (message_.open())
    message_.close();
  else if (open_)
    toggle_console();
  else
    menu_.show("main");
}

// Edits a typed line; false if the key is none that edits.
bool KeyRouter::edit(con::InputLine& line, const platform::InputEvent& event) {
  switch (event.key) {
    case platform::kKeyBackspace:
      ctrl_ ? line.erase_word_before() : line.erase_before();
      return true;
    case platform::kKeyDelete:
      ctrl_ ? line.erase_word_at() : line.erase_at();
      return true;
    case platform::kKeyLeftArrow:
      ctrl_ ? line.move_word(-1) : line.move(-1);
      return true;
    case platform::kKeyRightArrow:
      ctrl_ ? line.move_word(1) : line.move(1);
      return true;
    case platform::kKeyHome:
      line.home();
      return true;
    case platform::kKeyEnd:
      line.end();
      return true;
    case platform::kKeyInsert:
      shift_ ? paste(line) : line.set_overwriting(!line.overwriting());
      return true;
    default:
      if (!ctrl_ || alt_ || shortcut(event) != 'v') return false;
      paste(line);
      return true;
  }
}

// As in QuakeSpasm a line at a time: the next one might be a command that nobody has read.
void KeyRouter::paste(con::InputLine& line) {
  const std::size_t further = line.paste(con::typed_text(clipboard_()));
  if (further > 0) log_info("Pasted the first line; {} further {} left out.", further, further == 1 ? "was" : "were");
}

void KeyRouter::scroll(int lines) {
  const std::size_t all = console_.scrollback().size();
  const auto most = static_cast<std::ptrdiff_t>(all - std::min(all, rows_));
  const auto wanted = static_cast<std::ptrdiff_t>(scrolled_up_) + lines;
  scrolled_up_ = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(wanted, 0, most));
}

void KeyRouter::type(const platform::InputEvent& event) {
  const int page = ctrl_ ? std::max(static_cast<int>(rows_) - kLinesOfAPageKept, kScrolledLines) : kScrolledLines;
  switch (event.key) {
    case platform::kKeyEnter:
    case platform::kKeypadEnter:
      input_.enter(console_);
      scrolled_up_ = 0;
      return;
    case platform::kKeyTab:
      return input_.complete(console_, shift_ ? -1 : 1);
    case platform::kKeyUpArrow:
      return input_.recall(1);
    case platform::kKeyDownArrow:
      return input_.recall(-1);
    case platform::kKeyPageUp:
    case platform::kKeyWheelUp:
      return scroll(page);
    case platform::kKeyPageDown:
    case platform::kKeyWheelDown:
      return scroll(-page);
    case platform::kKeyHome:
      if (ctrl_) return scroll(kAllLines);
      break;
    case platform::kKeyEnd:
      if (ctrl_) return scroll(-kAllLines);
      break;
    case platform::kKeyRightArrow:
      if (!ctrl_) return input_.move_or_repeat();
      break;
    default:
      if (ctrl_ && !alt_ && shortcut(event) == 'c') return input_.abort();
      break;
  }
  edit(input_, event);
}

void KeyRouter::handle_menu_key(int key) {
  using ui::menu::Key;
  switch (key) {
    case platform::kKeyUpArrow:
      return menu_.press(Key::kUp);
    case platform::kKeyDownArrow:
      return menu_.press(Key::kDown);
    case platform::kKeyLeftArrow:
      return menu_.press(Key::kLeft);
    case platform::kKeyRightArrow:
      return menu_.press(Key::kRight);
    case platform::kKeyEnter:
    case platform::kKeypadEnter:
    case platform::kKeyAButton:
      return menu_.press(Key::kEnter);
    case platform::kKeyBButton:
      return menu_.press(Key::kBack);
    case platform::kKeyDelete:
    case platform::kKeyMouse3:
    case platform::kKeyYButton:
      return menu_.press(Key::kDelete);
    case platform::kKeyBackspace:
      return menu_.press(Key::kErase);
    case platform::kKeyPageUp:
    case platform::kKeyLeftShoulder:
      return menu_.press(Key::kPageUp);
    case platform::kKeyPageDown:
    case platform::kKeyRightShoulder:
      return menu_.press(Key::kPageDown);
    case platform::kKeyHome:
      return menu_.press(Key::kHome);
    case platform::kKeyEnd:
      return menu_.press(Key::kEnd);
    case platform::kKeyMouse1:
      menu_.point(pointer_.x, pointer_.y);
      return menu_.click();
    case platform::kKeyMouse2:
      return menu_.click(true);
    case platform::kKeyWheelUp:
      return menu_.wheel(-1);
    case platform::kKeyWheelDown:
      return menu_.wheel(1);
    default:
      return;
  }
}

void KeyRouter::steer(const vec2& stick, double now) {
  const ivec2 direction(stick.x > kSteer    ? 1
                        : stick.x < -kSteer ? -1
                                            : 0,
                        stick.y > kSteer    ? 1
                        : stick.y < -kSteer ? -1
                                            : 0);
  const bool fresh = direction != steered_;
  if (fresh) steer_again_ = now + kSteerDelay;
  steered_ = direction;
  if (!menu_.open() || direction == ivec2(0) || (!fresh && now < steer_again_)) return;
  if (!fresh) steer_again_ = now + kSteerRepeat;
  using ui::menu::Key;
  if (direction.y != 0)
    menu_.press(direction.y > 0 ? Key::kDown : Key::kUp);
  else
    menu_.press(direction.x > 0 ? Key::kRight : Key::kLeft);
}

void KeyRouter::handle_menu(const platform::InputEvent& event) {
  using Kind = platform::InputEvent::Kind;
  if (event.kind == Kind::kMouseMotion) {
    pointer_ = {event.x, event.y};
    if (menu_frames_ >= kPointerFrames) menu_.point(pointer_.x, pointer_.y);
  } else if (event.kind == Kind::kKey && event.down) {
    text_was_bound_ = menu_.capturing();
    if (text_was_bound_)
      menu_.bind(event.key == kKeyGrave || event.repeat ? platform::kKeyNone : event.key);
    else if (is_function_key(event.key))
      run_binding(event);
    else if (con::InputLine* const line = menu_.edited_line(); line == nullptr || !edit(*line, event))
      handle_menu_key(event.key);
  }
}

// What is typed goes to one of four places, in this order.
void KeyRouter::handle_text(const std::string& utf8) {
  if (ctrl_ && !alt_) return;  // AltGr is both
  const std::string text = con::typed_text(utf8);
  const bool toggles = text == "`" || text == "~";
  if (menu_.open()) {
    if (!text_was_bound_ && !toggles) menu_.type(text);
  } else if (message_.open()) {
    message_.input().type(text);
  } else if ((open_ || behind_ == Behind::kNothing) && !toggles) {
    input_.type(text);
  }
}

// The key that quits asks first; the command does not. Quake's configurations leave F8 free.
void KeyRouter::run_binding(const platform::InputEvent& event) {
  if (event.repeat) return;
  const std::string& command = bindings_.command(event.key);
  if (event.down && con::same_name(command, "quit")) return console_.append("menu_quit\n");
  if (event.down && event.key == kKeyPanel && command.empty()) return console_.append("togglepanel\n");
  bindings_.key_event(event.key, event.down);
}

bool counts_while_waiting(const platform::InputEvent& event) {
  using Kind = platform::InputEvent::Kind;
  return event.kind == Kind::kKey ? !event.down : event.kind != Kind::kText && event.kind != Kind::kMouseMotion;
}

void KeyRouter::handle(const platform::InputEvent& happened) {
  using Kind = platform::InputEvent::Kind;
  const platform::InputEvent event = pad_layer_.meant(happened, behind_ == Behind::kGame && !holds_game());
  if (event.kind == Kind::kFocus && !event.focused) {
    bindings_.release_all();
    alt_ = ctrl_ = shift_ = false;
  }
  const bool is_key = event.kind == Kind::kKey;
  if (is_key && event.key == platform::kKeyAlt) alt_ = event.down;
  if (is_key && event.key == platform::kKeyCtrl) ctrl_ = event.down;
  if (is_key && event.key == platform::kKeyShift) shift_ = event.down;
  if (alt_ && is_key && event.key == platform::kKeyEnter) {
    if (event.down && !event.repeat) console_.append("vid_toggle\n");
    return;
  }
  const bool elsewhere = menu_.open() || open_ || message_.open();
  if ((!elsewhere || (is_key && !event.down)) && panel_(event)) return;
  if (is_key && event.key == platform::kKeyEscape) {
    if (event.down && !event.repeat) escape();
    return;
  }
  if (is_key && event.key == kKeyGrave && !menu_.capturing() && !message_.open()) {
    if (event.down && !event.repeat) toggle_console();
    return;
  }
  // A button that was pressed before lets go wherever the keys go now.
  if (is_key && !event.down) {
    demo_keys_(event);
    return bindings_.key_event(event.key, false);
  }
  if (event.kind == Kind::kText) handle_text(event.text);
  if (menu_.open()) return handle_menu(event);
  if (message_.open()) {
    if (is_key && (event.key == platform::kKeyEnter || event.key == platform::kKeypadEnter))
      console_.append(message_.send());
    else if (is_key)
      edit(message_.input(), event);
    return;
  }
  const bool typing = open_ || behind_ == Behind::kNothing;
  if (!typing && behind_ == Behind::kDemo && demo_keys_(event)) return;
  if (!is_key) return;
  if (typing && !is_function_key(event.key)) return type(event);
  if (behind_ == Behind::kDemo && starts_typing(event.key) && !event.repeat) return menu_.show("main");
  run_binding(event);
}

// Lines that come leave those that are read where they are.
void KeyRouter::begin_console(std::size_t rows) {
  rows_ = rows;
  const std::uint64_t lines = console_.scrollback().total();
  scroll(scrolled_up_ > 0 ? static_cast<int>(std::min<std::uint64_t>(lines - lines_drawn_, kAllLines)) : 0);
  lines_drawn_ = lines;
}

void KeyRouter::begin_frame() {
  menu_frames_ = menu_.open() ? menu_frames_ + 1 : 0;
  menu_.update();
}

}  // namespace fb::host
