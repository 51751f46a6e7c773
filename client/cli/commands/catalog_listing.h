#pragma once

#include <absl/status/status.h>

#include <cstdio>
#include <string>
#include <vector>

#include "commands/context.h"
#include "json_output.h"

namespace isofield {

// A column of a listing. The width is in characters; it is negative for texts aligned to the left, as in printf().
struct ListingColumn {
  const char* name;
  int width;
};

// Says how the commands list, change and remove the entries of one of the server's catalogues, scenes or operators.
// `Summary` is the message that describes an entry.
template <class Summary>
struct Catalog {
  const char* json_name;  // the key of the list of entries in JSON
  absl::StatusOr<std::vector<Summary>> (Client::*list)();
  absl::Status (Client::*remove)(const std::string& name);
  std::string (*describe)(const Summary& summary);  // on one line
  std::vector<ListingColumn> columns;
  std::vector<std::string> (*row)(const Summary& summary);
};

// Prints a line with the names of the columns and a line for each row; prints nothing if there are no rows.
void print_listing(const std::vector<ListingColumn>& columns, const std::vector<std::vector<std::string>>& rows);

// Prints that an entry is deleted.
void print_deleted(const Context& context, const std::string& name);

// Asks the server for all entries and prints them.
template <class Summary>
absl::Status list_catalog(const Context& context, const Catalog<Summary>& catalog) {
  auto client = context.connect();
  if (!client.ok()) return client.status();
  const auto summaries = ((*client).*catalog.list)();
  if (!summaries.ok()) return summaries.status();
  if (context.json) {
    const std::vector<JsonObject> entries(summaries->begin(), summaries->end());
    // The keys are those of the answer, of which the client has asked for all pages.
    JsonObject().set(catalog.json_name, entries).set("has_more", false).print();
    return absl::OkStatus();
  }
  std::vector<std::vector<std::string>> rows;
  for (const Summary& summary : *summaries) rows.push_back(catalog.row(summary));
  print_listing(catalog.columns, rows);
  return absl::OkStatus();
}

// Deletes an entry of the server and says so.
template <class Summary>
absl::Status remove_entry(const Context& context, const Catalog<Summary>& catalog, const std::string& name) {
  auto client = context.connect();
  if (!client.ok()) return client.status();
  const absl::Status status = ((*client).*catalog.remove)(name);
  if (status.ok()) print_deleted(context, name);
  return status;
}

// Prints an entry that was stored or changed.
template <class Summary>
absl::Status print_entry(const Context& context, const Catalog<Summary>& catalog,
                         const absl::StatusOr<Summary>& summary) {
  if (!summary.ok()) return summary.status();
  if (context.json) {
    print_json(*summary);
  } else {
    std::printf("%s\n", catalog.describe(*summary).c_str());
  }
  return absl::OkStatus();
}

}  // namespace isofield
