# Writes TEXTS to OUTPUT as pairs of a name and a raw string literal: cmake -DTEXTS=... -DOUTPUT=... -P embed_texts.cmake
set(pairs "")
foreach(path ${TEXTS})
  get_filename_component(name ${path} NAME)
  file(READ ${path} text)
  string(APPEND pairs "{\"${name}\", R\"GLSL(${text})GLSL\"},\n")
endforeach()
file(WRITE ${OUTPUT} "${pairs}")
