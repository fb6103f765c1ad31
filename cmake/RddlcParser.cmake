# rddlc_check_parser(<folder> <grammar> <include>): whether a parser that ANTLR made before can be
# used: whether it is all there, of this very grammar, and fits the runtime that lies in <include>.
function(rddlc_check_parser folder grammar include)
  foreach(name RDDLLexer.cpp RDDLLexer.h RDDLParser.cpp RDDLParser.h RDDL.g4)
    if(NOT EXISTS ${folder}/${name})
      message(FATAL_ERROR "RDDLC_PARSER: there is no ${name} in ${folder}. scripts/release.sh makes such folders.")
    endif()
  endforeach()

  file(SHA256 ${folder}/RDDL.g4 made_of)
  file(SHA256 ${grammar} wanted)
  if(NOT made_of STREQUAL wanted)
    message(FATAL_ERROR "RDDLC_PARSER: the parser in ${folder} was made of another grammar than ${grammar}.")
  endif()

  # Parsers have another form from 4.10 on; the runtime has stated its version since then.
  file(STRINGS ${folder}/RDDLParser.cpp made_by REGEX "by ANTLR [0-9.]+" LIMIT_COUNT 1)
  string(REGEX MATCH "ANTLR ([0-9.]+)" made_by "${made_by}")
  set(version ${CMAKE_MATCH_1})
  if(version VERSION_LESS 4.10 AND EXISTS ${include}/Version.h)
    message(FATAL_ERROR "RDDLC_PARSER: ${made_by} made the parser in ${folder}, and the C++ runtime in ${include} is "
                        "4.10 or newer: they do not fit. Install ANTLR's tool, or an older runtime.")
  elseif(version VERSION_GREATER_EQUAL 4.10 AND NOT EXISTS ${include}/Version.h)
    message(FATAL_ERROR "RDDLC_PARSER: ${made_by} made the parser in ${folder}, and the C++ runtime in ${include} is "
                        "older than 4.10: they do not fit. Install ANTLR's tool, or a newer runtime.")
  endif()
endfunction()
