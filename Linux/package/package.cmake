# What an installation has, and the packages of it that `make package` makes (CPack): a .deb for the release of Debian
# that it is built on, and a .tar.gz of the same files, which runs from any folder of a system that has the libraries.
# The programs find the base game beside them (Quake/host/base_game.h).
if(NOT TARGET basegame OR NOT Python3_FOUND)
  return()
endif()
set(FB_PACKAGE_DIR ${CMAKE_BINARY_DIR}/package)
set(package ${CMAKE_SOURCE_DIR}/Linux/package)
add_custom_command(
  OUTPUT ${FB_PACKAGE_DIR}/fullbright.6 ${FB_PACKAGE_DIR}/fullbright-lab.1
  COMMAND ${Python3_EXECUTABLE} ${package}/man_pages.py $<TARGET_FILE:fullbright> $<TARGET_FILE:fullbright-lab>
          ${FB_PACKAGE_DIR}
  DEPENDS fullbright fullbright-lab ${package}/man_pages.py
  COMMENT "manual pages" VERBATIM)
add_custom_command(
  OUTPUT ${FB_PACKAGE_DIR}/fullbright.spdx.json
  COMMAND ${Python3_EXECUTABLE} ${package}/bill_of_materials.py ${PROJECT_VERSION} ${FB_PACKAGE_DIR}/fullbright.spdx.json
          $<TARGET_FILE:fullbright> $<TARGET_FILE:fullbright-lab>
  DEPENDS fullbright fullbright-lab ${package}/bill_of_materials.py
  COMMENT "bill of materials" VERBATIM)
set(tested "")
if(FULLBRIGHT_TESTS AND NOT FULLBRIGHT_SANITIZE)
  set(tested ALL)
  fb_whole_unless_passed(unless_passed package ${CMAKE_SOURCE_DIR}/CHANGELOG.md ${CMAKE_SOURCE_DIR}/LICENSE)
  add_test(NAME package COMMAND ${unless_passed} ${Python3_EXECUTABLE} ${package}/package_test.py ${CMAKE_BINARY_DIR} WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
  set_tests_properties(package PROPERTIES SKIP_RETURN_CODE 77 COST 30 LABELS slow)
endif()
add_custom_target(package_files ${tested} DEPENDS ${FB_PACKAGE_DIR}/fullbright.6 ${FB_PACKAGE_DIR}/fullbright-lab.1
                  ${FB_PACKAGE_DIR}/fullbright.spdx.json basegame)

install(TARGETS fullbright fullbright-lab RUNTIME DESTINATION bin)
install(DIRECTORY ${CMAKE_BINARY_DIR}/game DESTINATION share/fullbright)
install(FILES ${package}/fullbright.desktop DESTINATION share/applications)
install(FILES ${package}/fullbright.svg DESTINATION share/icons/hicolor/scalable/apps)
install(FILES ${FB_PACKAGE_DIR}/fullbright.6 DESTINATION share/man/man6)
install(FILES ${FB_PACKAGE_DIR}/fullbright-lab.1 DESTINATION share/man/man1)
install(FILES ${CMAKE_SOURCE_DIR}/LICENSE DESTINATION share/doc/fullbright RENAME copyright)
install(FILES ${CMAKE_SOURCE_DIR}/CHANGELOG.md ${FB_PACKAGE_DIR}/fullbright.spdx.json DESTINATION share/doc/fullbright)

set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_NAME fullbright)
set(CPACK_PACKAGE_VENDOR Fullbright)
set(CPACK_PACKAGE_CONTACT "The Fullbright maintainers <maintainers@fullbright.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Quake engine that path traces, with a game and a laboratory of light transport")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "Fullbright plays Quake's data and mods as QuakeSpasm does, lit by a Vulkan path\ntracer, with or without a GPU. A free game is included, and a laboratory that\nrenders references and measures estimators of light transport.")
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_DIRECTORY ${FB_PACKAGE_DIR})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SECTION games)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "mesa-vulkan-drivers")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "ffmpeg, python3-matplotlib")
include(CPack)
