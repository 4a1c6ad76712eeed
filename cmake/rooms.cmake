# A room is a folder, a namespace and a target of the same name. Rooms under sixstep/ are the library: compiled
# without exceptions and RTTI, which proves that they also live where neither exists. Their sources are those in the
# folder: no list repeats it.
function(sixstep_room name)
  cmake_parse_arguments(ROOM "LIBRARY" "" "SOURCES;DEPENDS" ${ARGN})
  if(ROOM_LIBRARY)
    file(GLOB_RECURSE ROOM_SOURCES CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  endif()
  if(ROOM_SOURCES)
    add_library(${name} STATIC ${ROOM_SOURCES})
    target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR})
    target_link_libraries(${name} PUBLIC ${ROOM_DEPENDS})
    # A forgotten member is an error in every room; a test names what it is about.
    target_compile_options(${name} PRIVATE -Wmissing-field-initializers)
    if(ROOM_LIBRARY)
      target_compile_options(${name} PRIVATE -fno-exceptions -fno-rtti)
    endif()
  else()
    add_library(${name} INTERFACE)
    target_include_directories(${name} INTERFACE ${PROJECT_SOURCE_DIR})
    target_link_libraries(${name} INTERFACE ${ROOM_DEPENDS})
  endif()
endfunction()

# -O1 pays only for instrumented targets with the engine, which run long enough (CMakeLists.txt).
function(sixstep_holds_engine target)
  if(SIXSTEP_SANITIZE)
    target_compile_options(${target} PRIVATE -O1)
  endif()
endfunction()

# A small source costs the reading of its headers: sixteen of a room are compiled together, in a third of the time. So what a
# room's sources keep for themselves has one name in the room. Compiled alone: what follows the target. Rooms that read JSON and
# formatting in nearly each source set a larger SIXSTEP_BATCH.
option(SIXSTEP_BATCHES "compile small sources together, tests too" ON)
set(SIXSTEP_BATCH 16)
function(sixstep_in_batches target)
  set(size ${SIXSTEP_BATCH})
  if(SIXSTEP_SANITIZE)
    set(size 16)  # instrumented, a batch of 47 took over three minutes
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${SIXSTEP_BATCHES} UNITY_BUILD_BATCH_SIZE ${size})
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# Sources of a library's room that are compiled apart: `size` of them together (0: all), a release with `level`.
function(sixstep_apart target name size level)
  if(SIXSTEP_SANITIZE AND size LESS SIXSTEP_BATCH)
    set(size 1)  # nothing is gained by few together there
  endif()
  set(sources)
  foreach(source ${ARGN})
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    list(APPEND sources ${source})
  endforeach()
  get_target_property(kept ${target} SOURCES)
  list(REMOVE_ITEM kept ${sources})
  set_target_properties(${target} PROPERTIES SOURCES "${kept}")
  add_library(${target}_${name} OBJECT ${sources})
  target_link_libraries(${target}_${name} PRIVATE $<TARGET_PROPERTY:${target},LINK_LIBRARIES>)
  get_target_property(options ${target} COMPILE_OPTIONS)
  target_compile_options(${target}_${name} PRIVATE ${options} $<$<CONFIG:Release>:${level}>)
  set_target_properties(${target}_${name} PROPERTIES UNITY_BUILD ${SIXSTEP_BATCHES} UNITY_BUILD_BATCH_SIZE ${size})
  target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_${name}>)
endfunction()

# Text files as C++ functions, so that the program needs nothing beside itself. PACKED: the program holds them compressed.
#   sixstep_embed(PACKED TARGET report NAMESPACE report::assets HEADER report_assets.hpp FILES a.html b.js)
# makes a function for each file, named after it with dots and dashes as underscores: report::assets::a_html().
function(sixstep_embed)
  cmake_parse_arguments(E "PACKED" "TARGET;NAMESPACE;HEADER" "FILES" ${ARGN})
  set(out ${CMAKE_CURRENT_BINARY_DIR}/embedded/${E_HEADER})
  add_custom_command(OUTPUT ${out}
    COMMAND python3 ${PROJECT_SOURCE_DIR}/tools/embed.py --namespace ${E_NAMESPACE} --out ${out} $<$<BOOL:${E_PACKED}>:--packed> ${E_FILES}
    DEPENDS ${PROJECT_SOURCE_DIR}/tools/embed.py ${E_FILES}
    COMMENT "Embedding ${E_HEADER}" VERBATIM COMMAND_EXPAND_LISTS)
  target_sources(${E_TARGET} PRIVATE ${out})
  target_include_directories(${E_TARGET} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/embedded)
endfunction()
