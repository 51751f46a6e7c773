# Writes the files TEXTS to the file OUTPUT as C++ pairs of a name and a raw string literal. A text's name is its path
# below one of FOLDERS, by which shaders include it. It is called as
# cmake -DTEXTS=... -DFOLDERS=... -DOUTPUT=... -P embed_texts.cmake.
set(pairs "")
foreach(path ${TEXTS})
  set(name ${path})
  foreach(folder ${FOLDERS})
    string(REPLACE "${folder}/" "" name ${name})
  endforeach()
  file(READ ${path} text)
  string(APPEND pairs "{\"${name}\", R\"GLSL(${text})GLSL\"},\n")
endforeach()
file(WRITE ${OUTPUT} "${pairs}")
