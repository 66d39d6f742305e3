// SPDX-License-Identifier: MIT
// physvib-thesis FOLDER: what the thesis prints beside what follows from it, as a page with tables.
#include "Io/Disk/AtomicFile.h"
#include "Thesis/ThesisReport.h"
#include <iostream>

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "physvib-thesis: expected a folder\n";
        return 2;
    }
    const std::filesystem::path folder{argv[1]};
    const auto files = physvib::thesisReport();
    for (const auto& [name, text] : files) {
        std::filesystem::create_directories((folder / name).parent_path());
        if (const auto fault = physvib::writeFile(folder / name, text); !fault.empty()) {
            std::cerr << "physvib-thesis: " << fault << '\n';
            return 1;
        }
    }
    std::cout << (folder / "index.html").string() << "  " << files.size()
              << " files; rehearsals are simulated\n";
}
