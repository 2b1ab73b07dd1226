// The headers that CMakeLists.txt names are precompiled with this file.
