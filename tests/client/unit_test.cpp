#include "isofield/unit.h"

#include <gtest/gtest.h>

namespace isofield {
namespace {

TEST(Unit, IsALengthInMetres) {
  for (const auto& [text, metres] : std::initializer_list<std::pair<const char*, double>>{
           {"m", 1},          {"metres", 1},  {"Meter", 1},        {"km", 1e3},          {"cm", 1e-2},
           {"mm", 1e-3},      {"um", 1e-6},   {"\u00b5m", 1e-6},   {"microns", 1e-6},    {"micrometre", 1e-6},
           {"nm", 1e-9},      {"pm", 1e-12},  {"angstrom", 1e-10}, {"Angstroms", 1e-10}, {"A", 1e-10},
           {"\u00c5", 1e-10}, {"in", 0.0254}, {"inches", 0.0254},  {"ft", 0.3048},       {" nm ", 1e-9}}) {
    ASSERT_TRUE(unit_in_metres(text)) << text;
    EXPECT_DOUBLE_EQ(*unit_in_metres(text), metres) << text;
  }
}

TEST(Unit, MayBeAMultiple) {
  EXPECT_DOUBLE_EQ(unit_in_metres("8 nm").value(), 8e-9);
  EXPECT_DOUBLE_EQ(unit_in_metres("8nm").value(), 8e-9);
  EXPECT_DOUBLE_EQ(unit_in_metres("0.25 um").value(), 0.25e-6);
  EXPECT_DOUBLE_EQ(unit_in_metres("1e-3 mm").value(), 1e-6);
}

TEST(Unit, OtherTextNamesNoLength) {
  for (const char* text :
       {"", " ", "8", "voxel", "Mm", "MM", "nM", "m/s", "0 nm", "-1 nm", "nan m", "1e999 m", "mm mm", "e", "1e m"}) {
    EXPECT_FALSE(unit_in_metres(text)) << text;
  }
}

}  // namespace
}  // namespace isofield
