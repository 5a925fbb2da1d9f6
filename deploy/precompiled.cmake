# Precompiled headers: what most sources include and nobody here changes. Halves the build time.
option(CONTACT_PRECOMPILE "Precompile headers of other projects" ON)

# contact_precompile(<name> LINK <library>... HEADERS <header>...): a target whose headers others reuse.
function(contact_precompile name)
  cmake_parse_arguments(P "" "" "LINK;HEADERS" ${ARGN})
  file(WRITE ${PROJECT_BINARY_DIR}/precompiled/${name}.cpp "")
  add_library(${name} STATIC ${PROJECT_BINARY_DIR}/precompiled/${name}.cpp)
  target_link_libraries(${name} PUBLIC ${P_LINK} PRIVATE contact_options)
  target_precompile_headers(${name} PRIVATE ${P_HEADERS})
  # ccache would take the header that is there for one of the sources, though it is of an older contract.
  if(CMAKE_CXX_COMPILER_LAUNCHER)
    set_target_properties(${name} PROPERTIES CXX_COMPILER_LAUNCHER
      "${PROJECT_SOURCE_DIR}/deploy/without-output;${CMAKE_CXX_COMPILER_LAUNCHER}")
  endif()
  # ccache takes two precompiled headers with the time of their making in them for different.
  target_compile_options(${name} PRIVATE
    "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endfunction()

function(contact_reuse_headers target precompiled)
  if(CONTACT_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${precompiled})
    target_link_libraries(${target} PRIVATE ${precompiled})
  endif()
endfunction()

set(standard
  <algorithm> <array> <chrono> <cmath> <cstdint> <cstdio> <filesystem> <functional> <map> <memory> <optional>
  <string> <string_view> <utility> <vector>)
if(CONTACT_PRECOMPILE)
  contact_precompile(pch_contract
    LINK contact_proto fmt::fmt
    HEADERS ${standard} <fmt/format.h> <contact/v1/job_service.pb.h>)
  contact_precompile(pch_grpc
    LINK contact_proto fmt::fmt
    HEADERS ${standard} <fmt/format.h> <grpcpp/grpcpp.h> <contact/v1/job_service.grpc.pb.h>)
  contact_precompile(pch_commands
    LINK contact_proto fmt::fmt CLI11::CLI11
    HEADERS ${standard} <fmt/format.h> <grpcpp/grpcpp.h> <contact/v1/job_service.grpc.pb.h> <CLI/CLI.hpp>)
endif()
