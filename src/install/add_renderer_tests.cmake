# plumbline_add_renderer_tests(TARGET SCENES SCENE... [CALL "{serve}"] [OPTIONS OPTION...] [SKIP_UNSUPPORTED])
#
# One ctest test, TARGET/SCENE, for each scene: `plumb diagnose` judges what the program TARGET draws. It fails where a
# stage differs, or where nothing could be judged, and prints the stage with its numbers and likely causes.
#   SCENE    a file or folder of scenes, beside CMakeLists.txt, or else in the suite that plumbline brings: `coverage`,
#            `clip/near.json`
#   CALL     the program's arguments (plumbline's kit): "{input} {output}" unless told, or "{serve}"
#   SKIP_UNSUPPORTED  scenes that the program says it does not draw are skipped; without it they fail
#   OPTIONS  of plumb diagnose: --conventions FILE, --from clip, --against exact
# A failing test leaves a page with a picture of every stage in plumbline_pages/TARGET/SCENE of the build folder.
function(plumbline_add_renderer_tests target)
  cmake_parse_arguments(PARSE_ARGV 1 tests "SKIP_UNSUPPORTED" "CALL" "SCENES;OPTIONS")
  if(NOT TARGET ${target} OR NOT tests_SCENES OR tests_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "plumbline_add_renderer_tests(${ARGV}): expected TARGET SCENES SCENE... [CALL CALL] [OPTIONS OPTION...] [SKIP_UNSUPPORTED]")
  endif()
  if(NOT tests_CALL)
    set(tests_CALL "{input} {output}")
  endif()
  foreach(scene ${tests_SCENES})
    set(files "")
    foreach(folder ${CMAKE_CURRENT_SOURCE_DIR} ${PLUMBLINE_SCENES})
      cmake_path(ABSOLUTE_PATH scene BASE_DIRECTORY ${folder} OUTPUT_VARIABLE path)
      if(EXISTS ${path})
        set(base ${folder})
        set(files ${path})
        if(IS_DIRECTORY ${path})
          file(GLOB_RECURSE files CONFIGURE_DEPENDS ${path}/*.json)
          list(FILTER files EXCLUDE REGEX "[.](part|schema)[.]json$")
        endif()
        break()
      endif()
    endforeach()
    if(NOT files)
      message(FATAL_ERROR "plumbline_add_renderer_tests: ${scene}: expected a scene or a folder of scenes in "
                          "${CMAKE_CURRENT_SOURCE_DIR} or ${PLUMBLINE_SCENES}")
    endif()
    foreach(file ${files})
      cmake_path(RELATIVE_PATH file BASE_DIRECTORY ${base} OUTPUT_VARIABLE name)
      string(REGEX REPLACE "[.]json$" "" name ${name})
      add_test(NAME ${target}/${name} COMMAND ${PLUMBLINE_PLUMB} diagnose ${file} --program "$<TARGET_FILE:${target}> ${tests_CALL}"
               --report ${CMAKE_CURRENT_BINARY_DIR}/plumbline_pages/${target}/${name} ${tests_OPTIONS})
      if(tests_SKIP_UNSUPPORTED)
        set_tests_properties(${target}/${name} PROPERTIES SKIP_REGULAR_EXPRESSION "not judged: the program does not draw it")
      endif()
    endforeach()
  endforeach()
endfunction()
