# cmake -DOUT=file.cc -DNAMESPACE=arboc -DFILES="name=path;..." -P embed.cmake: the files as one C++
# table.
set(text "#include <map>\n#include <string>\n\nnamespace ${NAMESPACE} {\n\n")
string(APPEND text "const std::map<std::string, std::string>& embedded_files() {\n")
string(APPEND text "  static const std::map<std::string, std::string> files = {\n")
foreach(entry IN LISTS FILES)
  string(REGEX MATCH "^([^=]+)=(.+)$" _ "${entry}")
  set(name "${CMAKE_MATCH_1}")
  file(READ "${CMAKE_MATCH_2}" content)
  string(APPEND text "{\"${name}\", R\"arboc_embed(${content})arboc_embed\"},\n")
endforeach()
string(APPEND text "  };\n  return files;\n}\n\n}  // namespace ${NAMESPACE}\n")
file(WRITE "${OUT}" "${text}")
