# Writes OUTPUT, the C++ source that holds the bytes of INPUT.
include(${CMAKE_CURRENT_LIST_DIR}/../../../../deploy/embed.cmake)
file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
string(REGEX REPLACE "(................................................................................)" "\\1\n"
  bytes "${bytes}")
contact_embed(${OUTPUT} cli/help/contract/contract.h "unsigned char" ContractBytes "${bytes}")
