// server_make_seed_corpus DIRECTORY: what the fuzzers start from, in a folder each: what players say, of each kind;
// saved games.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "net/client_messages.h"

namespace {

using fb::Bytes;
namespace net = fb::net;

void add_piece(Bytes& input, std::uint8_t how, const Bytes& piece) {
  input.push_back(how);
  input.push_back(static_cast<std::uint8_t>(piece.size()));
  input.insert(input.end(), piece.begin(), piece.end());
}

Bytes bytes_of(const net::ClientMessage& message, int protocol) {
  net::MessageWriter writer({protocol, 0});
  net::write_client_message(writer, message);
  return writer.bytes();
}

void write_saves(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::string header = "5\nTest__________________kills:__0/__0____\n";
  for (int i = 0; i < 16; ++i) header += "1.500000\n";
  header += "1\ntest\n12.345678\n";
  for (int i = 0; i < 64; ++i) header += "m\n";
  const std::string game =
      "{\n\"counter\" \"3.000000\"\n\"word\" \"two\\nlines\"\n\"marked\" \"2\"\n}\n"
      "{\n\"classname\" \"worldspawn\"\n\"model\" \"maps/test.bsp\"\n}\n{\n\"health\" \"100.000000\"\n}\n{\n}\n"
      "{\n\"origin\" \"1.500000 2.000000 -3.000000\"\n\"think\" \"thing_think\"\n\"enemy\" \"1\"\n\"way\" \"origin\"\n"
      "\"alpha\" \"0.500000\"\n\"angle\" \"90\"\n}\n";
  std::ofstream(folder / "header") << header;
  std::ofstream(folder / "whole") << header << game;
  std::ofstream(folder / "version6") << "6\nid1\n" << header.substr(2) << game;
  std::ofstream(folder / "unknown") << header << "{\n\"nothing\" \"1\"\n}\n{\n\"think\" \"none\"\n}\n";
}

// As fuzz_whole_server.cpp has it: 0 and 1 are what players say, reliably, 2 is a line of the console, 3 + 4 n are n
// ticks.
void write_whole(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const char* const games[][8] = {
      {"impulse 9", "god", "kill", "say hello", "name \"x\"", "color 1 2", "pause", "pause"},
      {"fly", "noclip", "notarget", "setpos 0 0 64", "give 7", "give r 50", "ping", "status"}};
  const char* const lines[][4] = {{"save a", "load a", "restart", "status"},
                                  {"edict 1", "edictcount", "skill 3", "sv_gravity 100; sv_maxspeed 3000"}};
  for (std::uint8_t game = 0; game < 2; ++game) {
    Bytes input = {static_cast<std::uint8_t>(game | 12)};
    const auto move = [&](std::uint8_t how, int buttons, int impulse) {
      add_piece(
          input, how,
          bytes_of(net::clc::Move{1.0f, fb::vec3(10, 90, 0), 400, 350, 200, buttons, impulse}, game == 0 ? 15 : 666));
    };
    for (const char* text : games[game])
      for (const std::uint8_t how : {0, 1}) add_piece(input, how, bytes_of(net::clc::StringCommand{text}, 15));
    for (const int impulse : {2, 3, 7, 8}) {
      move(0, 1, impulse);
      move(1, 3, impulse);
      input.push_back(3 + 4 * 5);
    }
    for (const char* line : lines[game]) {
      add_piece(input, 2, Bytes(line, line + std::string(line).size()));
      input.push_back(3 + 4 * 8);
    }
    std::ofstream(folder / std::to_string(game), std::ios::binary)
        .write(reinterpret_cast<const char*>(input.data()), static_cast<std::streamsize>(input.size()));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s DIRECTORY\n", argv[0]);
    return 2;
  }
  write_saves(std::filesystem::path(argv[1]) / "fuzz_save");
  write_whole(std::filesystem::path(argv[1]) / "fuzz_whole_server");
  const std::filesystem::path folder = std::filesystem::path(argv[1]) / "fuzz_client_messages";
  std::filesystem::create_directories(folder);
  constexpr int kProtocols[] = {15, 666, 999};
  for (std::uint8_t protocol = 0; protocol < 3; ++protocol) {
    for (const std::uint8_t signed_on : {0, 4, 8, 12}) {
      Bytes input = {static_cast<std::uint8_t>(protocol | signed_on)};
      const auto say = [&](std::uint8_t how, const net::ClientMessage& message) {
        add_piece(input, how, bytes_of(message, kProtocols[protocol]));
      };
      for (const char* text : {"prespawn",
                               "name \"player\"",
                               "color 4 3",
                               "spawn",
                               "begin",
                               "status",
                               "ping",
                               "say hello",
                               "say_team \"hello\"",
                               "tell player hello",
                               "kill",
                               "god",
                               "notarget",
                               "fly",
                               "noclip",
                               "give 7",
                               "give s 20",
                               "give a 150",
                               "setpos 1 2 3",
                               "setpos 1 2 3 4 5 6",
                               "pause",
                               "pause",
                               "kick # 2 why",
                               "quit"})
        for (const std::uint8_t how : {6, 1}) say(how, net::clc::StringCommand{text});
      say(0, net::clc::Move{1.0f, fb::vec3(10, 20, 0), 400, -350, 200, 3, 7});
      say(1, net::clc::Nop{});
      say(1, net::clc::Disconnect{});
      std::ofstream((folder / std::to_string(protocol | signed_on)), std::ios::binary)
          .write(reinterpret_cast<const char*>(input.data()), static_cast<std::streamsize>(input.size()));
    }
  }
  return 0;
}
