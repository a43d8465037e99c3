# Short commands. CMake and Ninja do the work (CMakePresets.json); this installs missing packages first (DEPS=: skips that)
# and calls them.
DEPS ?= Linux/install-deps.sh --quiet
JOBS ?= $(shell nproc)
FUZZ_SECONDS ?= 60
QUAKE_DIR ?=
export FUZZ_SECONDS QUAKE_DIR JOBS

.DEFAULT_GOAL := all
.PHONY: all deps test passed passed-sanitized demo play bench fuzz asan coverage settings-page check platforms package tidy format clean help

# Tests run one more at a time than there are processors: some of them wait. `make test` leaves that to run_tests.py.
#
# Arguments: preset, its folder, options of the build, options of CMake. Configuring is silent unless it fails. A first build compiles sources in
# groups, which halves its time; a folder that is configured already keeps what it says.
define configure_and_build
@mkdir -p $(2) && cmake --preset $(1) $(if $(wildcard $(2)/CMakeCache.txt),,-DFULLBRIGHT_QUICK_BUILD=ON) $(4) >$(2)/configure.log 2>&1 || { cat $(2)/configure.log; exit 1; }
@cmake --build --preset $(1) --parallel $(JOBS) $(3)
endef

all: ## build/fullbright and build/fullbright-lab, and the base game in build/game
	@$(DEPS) build
	$(call configure_and_build,release,build,--target fullbright fullbright-lab basegame)

test: ## build everything and run every test
	@$(DEPS) test
	$(call configure_and_build,release,build)
	@Misc/with_display.sh Misc/run_tests.py build

passed: ## run the tests that are known by what they passed with, where their files changed, and write Misc/passed.csv
	@$(DEPS) test
	$(call configure_and_build,release,build)
	@Misc/with_display.sh Misc/run_tests.py build --keep-passed --label-regex 'statistical|repeats|scripts|slow|drawn'
	@ray_query=$$(Linux/rayquery-lavapipe.sh build/rayquery-lavapipe) && \
	{ [ -z "$$ray_query" ] || env $$ray_query Misc/run_tests.py build --keep-passed --label-regex intersector; }

passed-sanitized: ## the same of CI's sanitized part: half an hour of two processors
	@$(DEPS) test fuzz
	$(call configure_and_build,release,build)
	@Misc/sanitized_part.sh --keep

demo: all ## play a recorded demo headless through the path tracer; QUAKE_DIR=... uses other data than the base game's
	@Misc/demo.sh

play: all ## play in a window: the base game, or the data in QUAKE_DIR; Escape opens the menu
	build/fullbright -basedir "$(or $(QUAKE_DIR),build/game)"

bench: ## run the benchmarks on this machine
	@$(DEPS) bench
	$(call configure_and_build,release,build)
	@Misc/bench.sh

fuzz: ## run each parser's fuzzer for FUZZ_SECONDS (60)
	@$(DEPS) fuzz
	@Misc/fuzz.sh

asan: ## build with the address and undefined-behaviour sanitizers and run every test
	@$(DEPS) test fuzz
	$(call configure_and_build,asan-ubsan,build-asan,,-DFULLBRIGHT_ALL_TESTS=ON)
	@Misc/with_display.sh Misc/sanitized.sh ctest --test-dir build-asan --parallel $$(($(JOBS) + 1)) --output-on-failure

coverage: ## measure the tests' line coverage: build-coverage/coverage.html
	@$(DEPS) coverage
	$(call configure_and_build,coverage,build-coverage)
	@find build-coverage -name '*.gcda' -delete
	Misc/with_display.sh ctest --test-dir build-coverage --parallel $$(($(JOBS) + 1)) --output-on-failure
	@merge=; if gcovr --help | grep -q merge-mode-functions; then merge=--merge-mode-functions=separate; fi; \
	gcovr --root . --filter Quake/ --filter Shaders/ --exclude '.*_test\.cpp' --exclude '.*_bench\.cpp' $$merge \
	  --print-summary --html-details build-coverage/coverage.html build-coverage

settings-page: all ## write Misc/docs/settings.md and commands.md from the settings' rows and what the game registers
	build/fullbright-lab settings >Misc/docs/settings.md
	build/fullbright-lab commands >Misc/docs/commands.md

check: ## check layers, formatting, text and includes of the sources
	@$(DEPS) check
	@Misc/check_layers.py --self-test && Misc/check_layers.py
	@Misc/check_text.py --self-test && Misc/check_text.py
	@Misc/check_includes.py --self-test && Misc/check_includes.py
	@Misc/check_format.sh

platforms: ## run make demo in a fresh installation of each Debian release that the README names
	@$(DEPS) platforms
	@Linux/platforms.sh

package: all ## build/package: a .deb for this release of Debian, and a .tar.gz of the same files
	@$(DEPS) package
	@SOURCE_DATE_EPOCH=$$(git log -1 --format=%ct) Linux/package/make.sh build

tidy: ## run clang-tidy on files that differ from BASE (default: the last commit shared with the main branch)
	@$(DEPS) check
	@Misc/tidy_changed.sh

format: ## format the sources by .clang-format
	@$(DEPS) check
	@Misc/check_format.sh --fix

deps: ## install all packages that these targets need
	@Linux/install-deps.sh all

clean: ## remove build results
	rm -rf build build-asan build-coverage

help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  make \1\t\2/p' Makefile | expand -t 24
