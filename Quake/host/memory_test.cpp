// Every allocation of the host's memory fails once, where maps are loaded, levels begin and run, and a scene goes to
// the device. A program of its own, for its operator new.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <functional>
#include <new>
#include <optional>
#include <string>

#include "base/hash.h"
#include "base/log.h"
#include "base/out_of_memory.h"
#include "client/client.h"
#include "console/console.h"
#include "formats/test_bsp.h"
#include "gpu/device.h"
#include "render/renderer.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/library/test_maps.h"
#include "server/test_server.h"

namespace {

// Of this thread's allocations, the one that fails: 0 is the next. Below: none.
thread_local std::int64_t until_failure = -1;
thread_local bool failed = false;

void* allocate(std::size_t bytes, std::size_t alignment) {
  if (until_failure >= 0 && until_failure-- == 0) {
    failed = true;
    return nullptr;
  }
  bytes = bytes == 0 ? 1 : bytes;
  return alignment <= alignof(std::max_align_t)
             ? std::malloc(bytes)
             : std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}
void* allocate_or_throw(std::size_t bytes, std::size_t alignment = 0) {
  void* memory = allocate(bytes, alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t bytes) { return allocate_or_throw(bytes); }
void* operator new[](std::size_t bytes) { return allocate_or_throw(bytes); }
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return allocate(bytes, 0); }
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept { return allocate(bytes, 0); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocate_or_throw(bytes, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return allocate_or_throw(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace fb {
namespace {

using testing::HasSubstr;

// Calls `work` with the nth allocation failing, for n from 0 on until there are not so many. `check(sentence)` is
// called after each failure, with what was thrown; empty if it was dealt with below. Past the first few hundred
// allocations every `stride`-th is tried.
std::size_t fail_each(std::size_t stride, const std::function<void()>& work,
                      const std::function<void(const std::string& thrown)>& check) {
  std::size_t failures = 0;
  for (std::size_t nth = 0; !testing::Test::HasFatalFailure(); nth += nth < 300 ? 1 : stride) {
    std::optional<OutOfMemory> thrown;
    failed = false;
    until_failure = static_cast<std::int64_t>(nth);
    try {
      work();
      until_failure = -1;
    } catch (const std::bad_alloc& failure) {
      until_failure = -1;
      thrown.emplace(sentence_of(failure));
    }
    if (!failed) return failures;
    ++failures;
    SCOPED_TRACE("allocation " + std::to_string(nth));
    check(thrown ? thrown->what() : "");
  }
  return failures;
}

Bytes small_map(const std::string& entities) {
  scene::test::MapBuilder map;
  const std::uint32_t floor = map.add_texture(scene::test::texture("floor")),
                      water = map.add_texture(scene::test::texture("*water", 230));
  for (int i = 0; i < 4; ++i) map.add_square(64.0f * static_cast<float>(i), 0, 0, 64, i % 2 == 0 ? floor : water);
  map.bsp.entities = entities;
  return formats::testing::write_bsp(map.bsp);
}

class LibraryMemoryTest : public testing::Test {
 protected:
  void SetUp() override {
    set_log_level(LogLevel::kError);
    files.add_palette();
    files.files["maps/a.bsp"] = small_map("{\"classname\" \"worldspawn\"}");
    files.files["maps/b.bsp"] = small_map(
        "{\"classname\" \"worldspawn\" \"_sunlight\" \"128\"}{\"classname\" \"light\" \"origin\" \"32 32 64\"}");
  }
  void TearDown() override { set_log_level(LogLevel::kInfo); }
  scene::test::TestFiles files;
};

TEST_F(LibraryMemoryTest, AMapThatDoesNotFitLeavesTheFormerOne) {
  scene::ModelLibrary library(files.loader());
  ASSERT_TRUE(library.load_map("maps/a.bsp").ok());
  const scene::Model* world = &library.model("maps/a.bsp");
  const auto assets = library.assets();
  const std::size_t meshes = assets->meshes.size(), materials = assets->materials.size();
  Status status = ok_status();
  const std::size_t failures = fail_each(
      1, [&] { status = library.load_map("maps/b.bsp"); },
      [&](const std::string& thrown) {
        // The error itself may find no memory.
        ASSERT_TRUE(!thrown.empty() || !status.ok());
        if (thrown.empty()) {
          ASSERT_THAT(status.error().message, HasSubstr("no memory"));
        }
        status = ok_status();
        ASSERT_EQ(library.assets(), assets);
        ASSERT_EQ(assets->meshes.size(), meshes);
        ASSERT_EQ(assets->materials.size(), materials);
        ASSERT_EQ(&library.model("maps/a.bsp"), world);
        ASSERT_TRUE(library.entity_lights().empty());
      });
  EXPECT_GT(failures, 30u);
  EXPECT_EQ(library.entity_lights().size(), 1u);
}

TEST_F(LibraryMemoryTest, AFirstMapThatDoesNotFitIsNoMap) {
  std::size_t failures = 0;
  scene::ModelLibrary library(files.loader());
  Status status = ok_status();
  failures = fail_each(
      1, [&] { status = library.load_map("maps/b.bsp"); },
      [&](const std::string&) {
        ASSERT_EQ(library.map(), nullptr);
        ASSERT_TRUE(library.entity_lights().empty());
      });
  EXPECT_GT(failures, 30u);
  ASSERT_TRUE(status.ok());
  EXPECT_EQ(library.entity_lights().size(), 1u);
  EXPECT_EQ(library.model("maps/b.bsp").kind, scene::ModelKind::kBrush);
}

// What is not dealt with below is given up by the frame loop: Client::give_up.
TEST_F(LibraryMemoryTest, AMapViewEndsAndAnotherBegins) {
  con::Console console;
  scene::ModelLibrary library(files.loader());
  cl::Client client(console, library, files.loader());
  ASSERT_TRUE(client.map_view("a").ok());
  std::size_t failures = 0;
  Status status = ok_status();
  scene::FrameSnapshot snapshot;
  failures = fail_each(
      1,
      [&] {
        status = client.map_view("b");
        if (!status.ok()) return;
        client.advance(0.1);
        client.build_snapshot(snapshot);
      },
      [&](const std::string& thrown) {
        if (thrown.empty()) {
          ASSERT_THAT(status.error().message, HasSubstr("no memory"));
        }
        client.give_up(Error{"given up"});
        ASSERT_FALSE(client.active());
        ASSERT_EQ(client.last_error()->message, "given up");
        client.advance(0.1);
        client.build_snapshot(snapshot);
        ASSERT_TRUE(snapshot.instances.empty());
        ASSERT_TRUE(client.map_view("a").ok());
        client.advance(0.1);
        client.build_snapshot(snapshot);
        ASSERT_FALSE(snapshot.instances.empty());
      });
  EXPECT_GT(failures, 50u);
  EXPECT_TRUE(client.active());
}

TEST(ConsoleMemory, ACommandThatFindsNoMemoryIsToldOfAndTheNextOneRuns) {
  con::Console console;
  int ran = 0;
  std::string errors;
  const int listener = add_log_listener([&](LogLevel level, std::string_view line) {
    if (level == LogLevel::kError) errors += std::string(line) + "\n";
  });
  console.add_command("greedy", "", [](const con::Args&) { throw OutOfMemory("too much is asked for"); });
  console.add_command("modest", "", [&](const con::Args&) { ++ran; });
  console.execute("greedy; modest");
  console.execute("modest");
  remove_log_listener(listener);
  EXPECT_EQ(ran, 2);
  EXPECT_EQ(errors, "greedy: too much is asked for\n");
}

class ServerMemoryTest : public sv::testing::ServerTest {
 protected:
  void start_game() {
    put_map("other", room(), R"({ "classname" "thing" })");
    start(R"(
        void() ponder = {
          says("words that are too long for a string to hold them in place");
          self.nextthink = time + 0.1;
        };
        void() thing = { self.think = ponder; self.nextthink = time + 0.1; };)",
          R"({ "classname" "thing" })");
  }
};

TEST_F(ServerMemoryTest, ALevelThatDoesNotFitLeavesTheFormerOneOrNone) {
  start_game();
  if (!server_) return;
  put_map("other", room(), R"({ "classname" "thing" })");
  bool stayed = false, ended = false;
  Status status = ok_status();
  const std::size_t failures = fail_each(
      23, [&] { status = server_->map("other"); },
      [&](const std::string& thrown) {
        ASSERT_EQ(thrown, "") << "it is the server's to deal with";
        ASSERT_THAT(status.error().message, HasSubstr("no memory"));
        stayed |= server_->active();
        ended |= !server_->active();
        if (server_->active()) {
          ASSERT_EQ(level().map_name, "test") << "a level that is half made";
          server_->frame(0.1, 1.0);
        }
        ASSERT_TRUE(server_->map("test").ok());
        server_->frame(0.1, 1.0);
        ASSERT_TRUE(server_->active());
      });
  EXPECT_GT(failures, 300u);
  EXPECT_TRUE(stayed && ended);
  EXPECT_TRUE(status.ok());
}

TEST_F(ServerMemoryTest, ATickThatFindsNoMemoryEndsTheGameAtMost) {
  start_game();
  if (!server_) return;
  const std::size_t failures = fail_each(
      1,
      [&] {
        for (int i = 0; i < 3; ++i) server_->frame(0.1, 1.0);
      },
      [&](const std::string& thrown) {
        ASSERT_EQ(thrown, "");
        if (server_->active()) return;
        ASSERT_TRUE(server_->last_error().has_value());
        ASSERT_TRUE(server_->map("test").ok());
        server_->frame(0.1, 1.0);
      });
  EXPECT_GT(failures, 1u);
  EXPECT_TRUE(server_->active());
}

// The driver's own allocations are not meant: its threads are not this one, and its compiler has done its work before.
TEST(RendererMemory, ASceneThatDoesNotFitLeavesTheFormerOne) {
  auto device = gpu::Device::create({});
  if (!device) GTEST_SKIP() << "no Vulkan device: " << device.error().message;
  render::RenderSettings settings;
  settings.accumulate = 0;
  auto made = render::Renderer::create(**device, settings);
  ASSERT_TRUE(made.ok()) << made.error().message;
  render::Renderer& renderer = **made;
  renderer.resize(16, 16);
  const auto picture = [&](const scene::FrameSnapshot& snapshot) {
    renderer.render(snapshot, nullptr, settings);
    return hash_span(std::span<const vec4>(renderer.read().linear()));
  };
  const scene::FrameSnapshot from = scene::cornell_box(), to = scene::many_lights(10);
  const std::uint64_t after = picture(to), before = picture(from);
  ASSERT_NE(before, after);
  const std::size_t failures = fail_each(
      7, [&] { renderer.render(to, nullptr, settings); },
      [&](const std::string& thrown) {
        ASSERT_THAT(thrown, HasSubstr("no memory"));
        ASSERT_EQ(picture(from), before);
      });
  EXPECT_GT(failures, 100u);
  EXPECT_EQ(picture(to), after);
}

}  // namespace
}  // namespace fb
