#!/usr/bin/env bash
# Builds the libraries that Fullbright needs on Windows, static ones, from Debian's source packages: those of
# Windows/dependencies.txt, fetched with apt from the mirror that this machine uses and checked against the sums there.
# The system's own lists are neither read nor changed. What is in DIR already, of the same version, is not built again.
#
#   usage: Windows/dependencies.sh DIR [JOBS [PACKAGE]...]    PACKAGE: only these; default: all
#
# DIR gets lib/, include/ and, in log/, what each build printed. Vulkan's headers are those that SDL's sources bring; the
# loader (vulkan-1.dll) comes with Windows' drivers, so that only an import library is made for it.
set -euo pipefail

say() { echo "dependencies.sh: $*" >&2; }
fail() { say "$*"; exit 1; }
[[ $# -ge 1 && $1 != -* ]] || { sed -n '2,9s/^# \{0,1\}//p' "$0" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1"
prefix=$(cd "$1" && pwd)
jobs=${2:-$(nproc)}
only=" ${*:3} "
host=x86_64-w64-mingw32

for tool in cmake ninja make pkg-config dpkg-source apt-get $host-gcc-posix $host-g++-posix $host-dlltool; do
  command -v "$tool" >/dev/null ||
    fail "there is no $tool: apt-get install cmake ninja-build make pkg-config dpkg-dev g++-mingw-w64-x86-64-posix"
done
mkdir -p "$prefix"/{built,log,sources,lib/pkgconfig,include}
export PKG_CONFIG_LIBDIR=$prefix/lib/pkgconfig PKG_CONFIG_PATH=
export CFLAGS="-O2 -DNDEBUG -w" CXXFLAGS="-O2 -DNDEBUG -w"

# Debian's list of sources, once a run, and only if something is to be fetched.
apt_ready=
sources_apt() {
  apt-get -q -o Dir::Etc::sourcelist="$prefix/sources/sources.list" -o Dir::Etc::sourceparts=- \
    -o Dir::Etc::preferencesparts=- -o Dir::State::lists="$prefix/sources/lists" -o Dir::Cache="$prefix/sources/cache" \
    -o APT::Sandbox::User="$(id -un)" -o Acquire::Languages=none -o Acquire::Retries=3 "$@" </dev/null
}
make_apt_ready() {
  [[ -z $apt_ready ]] || return 0
  # apt itself reports the mirror of the release, whatever the format of its sources.
  local mirror options="" keyring=/usr/share/keyrings/debian-archive-keyring.gpg
  mirror=$(apt-get indextargets --format '$(REPO_URI) $(ORIGIN) $(COMPONENT)' 'Created-By: Packages' |
    sed -n 's/ Debian main$//p' | grep -v security | head -n 1)
  [[ -n $mirror ]] || fail "apt's sources name no mirror of Debian"
  [[ ! -f $keyring ]] || options="[signed-by=$keyring] "
  mkdir -p "$prefix/sources/lists/partial" "$prefix/sources/cache/archives/partial"
  echo "deb-src $options$mirror bookworm main" >"$prefix/sources/sources.list"
  sources_apt update >"$prefix/log/apt.log" 2>&1 || fail "could not fetch the list of bookworm's sources from $mirror"
  apt_ready=1
}

# fetch NAME VERSION SUM: sets `folder`, that of its unpacked sources.
fetch() {
  local name=$1 version=$2 sum=$3 dsc
  dsc=$prefix/sources/${name}_${version#*:}.dsc
  folder=$prefix/sources/$name-${version#*:}
  if [[ ! -f $folder.ready ]]; then
    make_apt_ready
    (cd "$prefix/sources" && sources_apt --download-only source "$name=$version") >"$prefix/log/$name.log" 2>&1 ||
      fail "$name $version cannot be fetched: the mirror may have another version by now (apt-cache showsrc $name)"
    echo "$sum  $dsc" | sha256sum --quiet -c - >&2 ||
      fail "$dsc is not the file of dependencies.txt"
    rm -rf "$folder"
    (cd "$prefix/sources" && dpkg-source --no-check -x "$dsc" "$folder") >>"$prefix/log/$name.log" 2>&1 ||
      fail "$name cannot be unpacked, see $prefix/log/$name.log"
    touch "$folder.ready"
  fi
}

with_cmake() {
  cmake -S . -B build-windows -G Ninja -DCMAKE_TOOLCHAIN_FILE="$here/toolchain.cmake" \
    -DFULLBRIGHT_WINDOWS_DEPS="$prefix" -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_INSTALL_LIBDIR=lib \
    -DCMAKE_BUILD_TYPE=None -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF "$@"
  ninja -C build-windows -j "$jobs" install
}
with_configure() {
  CC=$host-gcc-posix CXX=$host-g++-posix ./configure --host=$host --prefix="$prefix" --enable-static --disable-shared \
    --disable-dependency-tracking "$@"
  make -j "$jobs"
  make install
}
# A pkg-config file: NAME VERSION LIBS [CFLAGS]
pc() {
  printf 'Name: %s\nDescription: %s\nVersion: %s\nLibs: -L%s/lib %s\nCflags: -I%s/include %s\n' "$1" "$1" "$2" "$prefix" "$3" \
    "$prefix" "${4:-}" >"$prefix/lib/pkgconfig/$1.pc"
}
# archive LIBRARY FILES...: a library of plain sources.
archive() {
  local library=$1
  shift
  local objects=()
  for file in "$@"; do
    objects+=("$(basename "$file").o")
    case $file in
    *.cpp) $host-g++-posix $CXXFLAGS -I. -c "$file" -o "${objects[-1]}" ;;
    *) $host-gcc-posix $CFLAGS -I. -c "$file" -o "${objects[-1]}" ;;
    esac
  done
  rm -f "$prefix/lib/$library"
  $host-ar crs "$prefix/lib/$library" "${objects[@]}"
}

build_zlib() {
  archive libz.a adler32.c compress.c crc32.c deflate.c gzclose.c gzlib.c gzread.c gzwrite.c infback.c inffast.c inflate.c \
    inftrees.c trees.c uncompr.c zutil.c
  cp zlib.h zconf.h "$prefix/include"
  pc zlib 1.2.13 -lz
}
build_libpng1.6() { with_cmake -DPNG_SHARED=OFF -DPNG_STATIC=ON -DPNG_TESTS=OFF -DPNG_EXECUTABLES=OFF; }
build_libzip() {
  with_cmake -DENABLE_COMMONCRYPTO=OFF -DENABLE_GNUTLS=OFF -DENABLE_MBEDTLS=OFF -DENABLE_OPENSSL=OFF \
    -DENABLE_WINDOWS_CRYPTO=OFF -DENABLE_BZIP2=OFF -DENABLE_LZMA=OFF -DENABLE_ZSTD=OFF -DBUILD_TOOLS=OFF \
    -DBUILD_REGRESS=OFF -DBUILD_EXAMPLES=OFF -DBUILD_DOC=OFF
}
build_fmtlib() { with_cmake -DFMT_TEST=OFF -DFMT_DOC=OFF; }
build_xxhash() {
  archive libxxhash.a xxhash.c
  cp xxhash.h xxh3.h "$prefix/include"
  pc libxxhash 0.8.1 -lxxhash
}
build_glm() { with_cmake -DGLM_TEST_ENABLE=OFF; }
build_cli11() { with_cmake -DCLI11_BUILD_TESTS=OFF -DCLI11_BUILD_EXAMPLES=OFF -DCLI11_BUILD_DOCS=OFF; }
build_nlohmann-json3() { with_cmake -DJSON_BuildTests=OFF; }
build_googletest() { CXXFLAGS="-O1 -w" with_cmake -DBUILD_GMOCK=ON; }
build_imath() { with_cmake -DPYTHON=OFF; }
build_openexr() {
  with_cmake -DOPENEXR_BUILD_TOOLS=OFF -DOPENEXR_INSTALL_EXAMPLES=OFF -DOPENEXR_INSTALL_TOOLS=OFF
}
build_fftw3() { with_configure --disable-fortran --disable-doc --disable-threads; }
build_libsdl2() {
  with_cmake -DSDL_SHARED=OFF -DSDL_STATIC=ON -DSDL_TEST=OFF -DSDL2_DISABLE_SDL2MAIN=ON
  cp -r src/video/khronos/vulkan src/video/khronos/vk_video "$prefix/include" 2>/dev/null ||
    cp -r src/video/khronos/vulkan "$prefix/include"
  # The loader's functions: the prototypes of the core and of what puts pictures into windows.
  { echo "LIBRARY vulkan-1.dll"; echo EXPORTS
    sed -n 's/^VKAPI_ATTR .* VKAPI_CALL \(vk[A-Za-z0-9]*\)(.*/\1/p' "$prefix"/include/vulkan/vulkan_{core,win32}.h | sort -u
  } >vulkan-1.def
  $host-dlltool -d vulkan-1.def -l "$prefix/lib/libvulkan-1.dll.a"
}
build_imgui() {
  archive libimgui.a imgui.cpp imgui_demo.cpp imgui_draw.cpp imgui_tables.cpp imgui_widgets.cpp
  mkdir -p "$prefix/include/imgui"
  cp ./*.h "$prefix/include/imgui"
  pc imgui 1.86 "-limgui -limm32" "-I$prefix/include/imgui"
}
build_libogg() { with_cmake -DINSTALL_DOCS=OFF; }
build_libvorbis() { with_cmake; }
build_flac() {
  with_cmake -DBUILD_CXXLIBS=OFF -DBUILD_PROGRAMS=OFF -DBUILD_EXAMPLES=OFF -DBUILD_DOCS=OFF -DINSTALL_MANPAGES=OFF
}
build_opus() { with_configure --disable-doc --disable-extra-programs; }
build_mpg123() { with_configure --disable-components --enable-libmpg123; }
build_lame() { with_configure --disable-frontend --disable-gtktest --disable-decoder; }
build_libsndfile() {
  with_cmake -DBUILD_PROGRAMS=OFF -DBUILD_EXAMPLES=OFF -DENABLE_CPACK=OFF -DENABLE_EXTERNAL_LIBS=ON -DENABLE_MPEG=ON \
    -DCMAKE_C_FLAGS="$CFLAGS -DFLAC__NO_DLL"
}
build_libopenmpt() {
  with_configure --disable-openmpt123 --disable-examples --disable-tests --disable-doxygen-doc --without-portaudio \
    --without-portaudiocpp --without-pulseaudio --without-sdl2 --without-flac --without-sndfile
}

while read -r name version sum; do
  [[ -n $name && $name != \#* ]] || continue
  [[ $only == "  " || $only == *" $name "* ]] || continue
  built=$prefix/built/$name
  if [[ -f $built && $(<"$built") == "$version $sum" ]]; then continue; fi
  say "$name $version"
  fetch "$name" "$version" "$sum"
  (cd "$folder" && rm -rf build-windows && set -x && "build_$name") >>"$prefix/log/$name.log" 2>&1 &  # so that set -e holds in it
  wait $! || {
    tail -n 20 "$prefix/log/$name.log" >&2
    fail "$name cannot be built, see $prefix/log/$name.log"
  }
  echo "$version $sum" >"$built"
done <"$here/dependencies.txt"
say "the libraries stand in $prefix"
