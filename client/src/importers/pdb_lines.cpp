#include "importers/pdb_lines.h"

#include <absl/strings/ascii.h>
#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>

#include <algorithm>
#include <cmath>
#include <gemmi/resinfo.hpp>

#include "importers/atom_element.h"
#include "importers/import_report.h"
#include "importers/pdb_columns.h"
#include "importers/text.h"

namespace isofield {
namespace {

// The number of columns of a record.
constexpr std::size_t kWidth = 80;
// The number of serial numbers that hybrid-36 has: those of five decimal digits and those that begin with a capital
// letter.
constexpr std::size_t kSerialLimit = 100'000 + 26 * 36 * 36 * 36 * 36;

enum class Record { kAtom, kModel, kEndOfModel, kAssembly, kOther };

// Returns the kind of a record. Names of records have up to six letters. The name ATOM may touch its serial number, as
// in "ATOM100000".
Record record_of(absl::string_view line) {
  const absl::string_view name = pdb_field(line, 1, 6);
  const auto is = [&](absl::string_view known) { return absl::EqualsIgnoreCase(name, known); };
  if (is("HETATM") || (absl::StartsWithIgnoreCase(name, "ATOM") &&
                       (name.size() == 4 || absl::string_view("0123456789\t ").find(name[4]) != name.npos))) {
    return Record::kAtom;
  }
  if (is("MODEL")) return Record::kModel;
  if (is("ENDMDL") || is("END")) return Record::kEndOfModel;
  if (is("REMARK") && pdb_field(line, 8, 10) == "350") return Record::kAssembly;
  return Record::kOther;
}

// Reads the next line without the blanks before the name of its record. Returns false at the end of the text.
bool next_record(LineReader& lines, absl::string_view& line) {
  if (!lines.next_raw(line)) return false;
  line.remove_prefix(std::min(line.size(), line.find_first_not_of(" \t")));
  return true;
}

// Counts models along a file's records: MODEL begins one, and so does an atom after the end of one.
class ModelCounter {
 public:
  void pass(Record record) {
    if (record == Record::kEndOfModel) {
      open_ = false;
    } else if (record == Record::kModel || (record == Record::kAtom && !open_)) {
      ++model_;
      open_ = true;
    }
  }
  int model() const { return model_; }

 private:
  int model_ = 0;
  bool open_ = false;
};

// Writes a serial number in five characters, in hybrid-36: "A0000" follows 99999.
std::string hybrid_36(std::size_t serial) {
  if (serial < 100'000) return absl::StrCat(absl::Dec(serial, absl::kSpacePad5));
  constexpr std::size_t kA0000 = 10u * 36 * 36 * 36 * 36;
  std::string digits(5, '0');
  std::size_t rest = serial - 100'000 + kA0000;
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit, rest /= 36) {
    *digit = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ"[rest % 36];
  }
  return digits;
}

// Finds out whether the atom names of the file are right-justified. The first name of an element with one letter tells.
class NameStyle {
 public:
  void pass(absl::string_view line) {
    if (known_) return;
    const absl::string_view name = pdb_columns(line, 13, 16);
    if (name.size() < 4 || name[3] != ' ' || !is_carbon_or_kin(absl::StripAsciiWhitespace(name))) return;
    known_ = true;
    left_justified_ = name[0] != ' ';
  }
  NameColumns columns() const { return left_justified_ ? NameColumns::kLeftJustified : NameColumns::kRightJustified; }

 private:
  // Returns true for "C", "N1", "O12" and the like: a letter with nothing but digits after it cannot be another
  // element.
  static bool is_carbon_or_kin(absl::string_view name) {
    return name.find_first_of("CNOcno") == 0 && name.find_first_not_of("0123456789", 1) == name.npos;
  }

  bool known_ = false;
  bool left_justified_ = false;
};

// Returns the element in columns 77 and 78. A charge after it, which may begin in column 78 ("N1+"), is left out.
const Element* stated_element(absl::string_view line) {
  absl::string_view field = pdb_field(line, 77, 78);
  while (!field.empty() && !absl::ascii_isalpha(static_cast<unsigned char>(field.back()))) field.remove_suffix(1);
  return find_element(field);
}

// Adds the atoms of the chosen model to a PdbLines, and mends or drops their lines.
class PdbMender {
 public:
  PdbMender(NameColumns columns, PdbLines& result, ImportReport& report)
      : columns_(columns), result_(result), report_(report) {}

  absl::Status add_atom(std::size_t number, absl::string_view line) {
    const AtomSource source{number, line};
    absl::string_view mended = line;
    if (!has_coordinates(line)) {
      auto moved = with_fields_in_columns(line);
      if (!moved) {
        note(report_, "atom dropped: columns 31 to 54 do not hold three finite coordinates of a usable size", number,
             line);
        return absl::OkStatus();
      }
      note(report_, "line mended: its fields are not in their columns", number, line);
      mended = result_.mended.emplace_back(*std::move(moved));
    }
    if (result_.atoms.size() >= kSerialLimit) {
      return absl::InvalidArgumentError(absl::StrCat("more than ", kSerialLimit, " atoms in one model"));
    }
    PdbAtomLine& atom = result_.atoms.emplace_back();
    atom.source = source;
    fill(mended, atom);
    append(mended, atom);
    return absl::OkStatus();
  }

 private:
  void fill(absl::string_view line, PdbAtomLine& atom) {
    atom.name = pdb_field(line, 13, 16);
    atom.altloc = pdb_field(line, 17, 17);
    atom.number = pdb_field(line, 23, 27);
    atom.residue = pdb_field(line, 18, 20);
    atom.chain = pdb_field(line, 22, 22);
    if (!pdb_field(line, 21, 21).empty()) {
      // Column 21 holds the fourth letter of a residue's name or the first one of a chain's. It is a chain's where the
      // three letters before it are a known residue.
      if (gemmi::find_tabulated_residue(absl::AsciiStrToUpper(atom.residue)).found()) {
        atom.chain = pdb_field(line, 21, 22);
      } else {
        atom.residue = pdb_field(line, 18, 21);
      }
    }
    atom.element = stated_element(line);
    if (atom.element && is_foreign(*atom.element, atom.residue)) {
      note(report_, "element in columns 77 and 78 cannot be in its residue: taken from the atom's name",
           atom.source.line_number, atom.source.line);
      atom.element = nullptr;
    }
    if (!atom.element) atom.element = element_of_name(pdb_columns(line, 13, 16), atom.residue, columns_);
  }

  // Appends the record for the reader of gemmi, with only the fields that it needs and in printable characters.
  void append(absl::string_view line, const PdbAtomLine& atom) {
    std::string& text = result_.text;
    const std::size_t begin = text.size();
    absl::StrAppend(&text, line.substr(0, 66));
    text.resize(begin + kWidth, ' ');
    for (std::size_t i = begin; i < text.size(); ++i) {
      if (!absl::ascii_isprint(static_cast<unsigned char>(text[i]))) text[i] = '?';
    }
    const auto put = [&](std::size_t column, absl::string_view field) {
      std::copy(field.begin(), field.end(), text.begin() + static_cast<std::ptrdiff_t>(begin + column - 1));
    };
    put(1, absl::ascii_toupper(static_cast<unsigned char>(text[begin])) == 'H' ? "HETATM" : "ATOM  ");
    put(7, hybrid_36(result_.atoms.size() - 1));
    put(12, " ");
    put(21, atom.chain.size() > 1 ? atom.chain.substr(0, 1) : " ");
    const auto occupancy = parse_double(pdb_field(line, 55, 60));
    if (!occupancy || !std::isfinite(*occupancy)) put(55, "  1.00");
    put(61, "  0.00");
    text += '\n';
  }

  const NameColumns columns_;
  PdbLines& result_;
  ImportReport& report_;
};

}  // namespace

absl::StatusOr<PdbLines> mend_pdb(const std::string& text, const ImportOptions& options, ImportReport& report) {
  ModelCounter models;
  NameStyle style;
  absl::string_view line;
  for (LineReader lines(text); next_record(lines, line);) {
    const Record record = record_of(line);
    models.pass(record);
    if (record != Record::kAtom) continue;
    ++report.read;
    style.pass(line);
  }
  if (report.read == 0) return absl::InvalidArgumentError("no ATOM or HETATM record");
  const auto chosen = choose_frame("model", models.model(), options, report);
  if (!chosen.ok()) return chosen.status();

  PdbLines result;
  PdbMender mender(style.columns(), result, report);
  ModelCounter counter;
  for (LineReader lines(text); next_record(lines, line);) {
    const Record record = record_of(line);
    counter.pass(record);
    if (record == Record::kAssembly) {
      absl::StrAppend(&result.text, line.substr(0, kWidth), "\n");
    } else if (record == Record::kAtom && counter.model() == *chosen) {
      if (auto status = mender.add_atom(lines.number(), line); !status.ok()) return status;
    } else if (record == Record::kAtom) {
      note(report, "atom left out: of another model", lines.number(), line, false);
    }
  }
  return result;
}

}  // namespace isofield
