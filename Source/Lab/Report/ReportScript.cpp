// SPDX-License-Identifier: MIT
// Writes the R script: functions that read columns as `physvib analyse` does, then one line per test.
#include "Lab/Report/ReportScript.h"
#include "Io/Text/CleanText.h"

namespace physvib {
namespace {

constexpr std::string_view scriptHead =
    R"R(# Repeats the tests of this report: Rscript report.R, in its folder. Needs R with the package afex (Debian: r-base-core r-cran-afex).
suppressMessages(library(afex))
options(warn = -1)
checked <- 0; differing <- 0

table.of <- function(file) read.csv(file, comment.char = "#", colClasses = "character", check.names = FALSE, encoding = "UTF-8")
# The level of a factor in each row: a column, the second part of one (condition.2), a word of condition or stimulus (pair=wood), or a letter of a
# method's name (A of AV-FF-DRV).
level.in <- function(cell, factor) {
  for (word in strsplit(cell, " ", fixed = TRUE)[[1]]) {
    if (startsWith(word, paste0(factor, "="))) return(substring(word, nchar(factor) + 2))
    for (part in strsplit(word, "-", fixed = TRUE)[[1]]) if (part %in% paste0(factor, c("V", "F"))) return(substring(part, nchar(factor) + 1))
  }
  NA
}
level <- function(d, factor) {
  if (factor %in% names(d)) return(d[[factor]])
  column <- sub("\\.[1-9]$", "", factor)
  if (column != factor && column %in% names(d)) return(sapply(strsplit(d[[column]], "-", fixed = TRUE), `[`, as.integer(sub(".*\\.", "", factor))))
  found <- rep(NA_character_, nrow(d))
  for (column in intersect(c("stimulus", "condition"), names(d))) { own <- sapply(d[[column]], level.in, factor); found <- ifelse(is.na(own), found, own) }
  unname(found)
}
rows.of <- function(file, measure, within, where = character()) {
  d <- table.of(file)
  if ("phase" %in% names(d)) d <- d[d$phase != "training", ]
  for (words in where) d <- d[level(d, sub("=.*", "", words)) == sub("^[^=]*=", "", words), ]
  if (measure %in% names(d)) { d <- d[!(d[[measure]] %in% c("", "NA")), ]; y <- as.numeric(d[[measure]]) }
  else { cells <- d[[sub("=.*", "", measure)]]; d <- d[!(cells %in% c("", "NA")), ]; y <- as.numeric(d[[sub("=.*", "", measure)]] == sub("^[^=]*=", "", measure)) }
  rows <- data.frame(id = d$participant, y = y)
  for (i in seq_along(within)) { own <- level(d, within[i]); rows[[paste0("w", i)]] <- factor(own, levels = unique(own)) }
  rows
}
# Means by participant and cell; participants who miss a cell are left out, as in the report.
cells.of <- function(rows, factors) {
  means <- aggregate(rows["y"], rows[c("id", factors)], mean)
  cells <- prod(sapply(factors, function(f) nlevels(rows[[f]])))
  whole <- names(which(table(means$id) == cells))
  means[means$id %in% whole, ]
}
# A participant per row, a level per column: means over the cells of all other factors.
matrix.of <- function(rows, within, i) {
  means <- cells.of(rows, paste0("w", seq_along(within)))
  with(means, tapply(y, list(id, means[[paste0("w", i)]]), mean))
}

check <- function(test, ours, effects, p, corrected = NULL) {
  told <- table.of(ours)
  for (i in seq_along(effects)) {
    row <- told[told$effect == effects[i], ]
    compare(paste(test, effects[i]), as.numeric(row$p), p[i])
    if (!is.null(corrected) && !is.na(corrected[i])) compare(paste(test, effects[i], "(corrected)"), as.numeric(row$p_corrected), corrected[i])
  }
  if (nrow(told) != length(effects)) { differing <<- differing + 1; cat("DIFFERS", test, "has", nrow(told), "lines, R", length(effects), "\n") }
}
compare <- function(words, ours, r) {
  checked <<- checked + 1
  ok <- length(ours) == 1 && !is.na(ours) && !is.na(r) && abs(ours - r) <= max(1e-6 * r, 1e-12)
  if (!ok) differing <<- differing + 1
  cat(sprintf("%s %s: report p = %.9g, R p = %.9g\n", if (ok) "same   " else "DIFFERS", words, if (length(ours) == 1) ours else NaN, r))
}

anova.test <- function(ours, file, measure, within, where = character()) {
  means <- cells.of(rows.of(file, measure, within, where), paste0("w", seq_along(within)))
  fit <- suppressMessages(aov_ez("id", "y", means, within = paste0("w", seq_along(within)), type = 3, include_aov = FALSE, anova_table = list(es = "ges", correction = "none")))
  found <- rownames(fit$anova_table); p <- fit$anova_table[["Pr(>F)"]]
  adjusted <- if (inherits(fit$Anova, "Anova.mlm")) summary(fit$Anova, multivariate = FALSE)$pval.adjustments else NULL
  # an effect of one dimension has no correction; car leaves out those with fewer participants than dimensions
  dimensions <- sapply(strsplit(found, ":"), function(parts) prod(sapply(parts, function(f) nlevels(means[[f]]) - 1)))
  corrected <- sapply(found, function(e) if (dimensions[match(e, found)] > 1 && !is.null(adjusted) && e %in% rownames(adjusted)) adjusted[e, "Pr(>F[GG])"] else NA)
  effects <- sapply(strsplit(found, ":"), function(parts) paste(within[as.integer(sub("w", "", parts))], collapse = ":"))
  check("anova", ours, effects, p, corrected)
}
friedman <- function(ours, file, measure, within, where = character()) {
  rows <- rows.of(file, measure, within, where)
  check("friedman", ours, within, sapply(seq_along(within), function(i) friedman.test(matrix.of(rows, within, i))$p.value))
}
pairs.test <- function(ours, file, measure, within, where = character(), by = "t", correction = "holm") {
  rows <- rows.of(file, measure, within, where)
  effects <- character(); p <- numeric()
  for (i in seq_along(within)) {
    m <- matrix.of(rows, within, i); two <- combn(ncol(m), 2)
    for (k in seq_len(ncol(two))) {
      a <- m[, two[1, k]]; b <- m[, two[2, k]]
      effects <- c(effects, paste0(within[i], ": ", colnames(m)[two[1, k]], " - ", colnames(m)[two[2, k]]))
      p <- c(p, if (by == "t") t.test(a, b, paired = TRUE)$p.value else wilcox.test(a, b, paired = TRUE)$p.value)
    }
  }
  check("pairs", ours, effects, p, p.adjust(p, correction))
}
# Signed ranks of participants' shares against one half, for all trials, each word of a condition, each condition.
choices <- function(ours, file) {
  d <- table.of(file); told <- table.of(ours)
  if ("phase" %in% names(d)) d <- d[d$phase != "training", ]
  if ("task" %in% names(d)) d <- d[d$task == "choose", ]
  chosen <- if ("choice" %in% names(d)) d$choice else d$response
  kind <- if ("stimulus" %in% names(d)) d$stimulus else if ("condition" %in% names(d)) d$condition else rep("", nrow(d))
  for (k in which(told$p_signed_ranks != "")) {
    name <- told$condition[k]
    of <- if (name == "all" && k <= 2) rep(TRUE, nrow(d)) else kind == name | grepl(paste0(" ", name, " "), paste0(" ", kind, " "), fixed = TRUE)
    hits <- tapply(chosen[of] == told$alternative[k], d$participant[of], sum); n <- tapply(chosen[of], d$participant[of], length)
    compare(paste("choices", name, told$alternative[k]), as.numeric(told$p_signed_ranks[k]), wilcox.test((2 * hits - n) / n)$p.value)
  }
}

)R";

/// A quoted and escaped R string.
std::string inR(const std::string& words) {
    std::string out = "\"";
    for (const char c : cleanLine(words)) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + "\"";
}

std::string vectorInR(const std::vector<std::string>& words) {
    std::string out = "c(";
    for (const std::string& word : words) out.append(out.size() > 2 ? ", " : "").append(inR(word));
    return out + ")";
}

std::string lineOf(const ReportTest& test) {
    const std::string function = test.analysis == "anova"   ? "anova.test"
                                 : test.analysis == "pairs" ? "pairs.test"
                                                            : test.analysis;
    std::string line = function + "(" + inR(test.table) + ", " + inR(test.options.files.front()) + ", " +
                       inR(test.options.measure) + ", " + vectorInR(test.options.within);
    if (!test.options.where.empty()) line += ", where = " + vectorInR(test.options.where);
    if (test.analysis == "pairs" && test.options.pairTest == PairTest::ranks) line += ", by = \"ranks\"";
    if (test.analysis == "pairs" && test.options.correction == Correction::bonferroni)
        line += ", correction = \"bonferroni\"";
    return line + ")\n";
}

} // namespace

std::string reportScript(const ReportBuilder& report) {
    std::string script{scriptHead};
    for (const ReportTest& test : report.tests()) script += lineOf(test);
    if (report.tables().contains("choices.csv")) script += "choices(\"choices.csv\", \"trials.csv\")\n";
    return script +
           "\ncat(checked, \"p repeated,\", differing, \"differ\\n\")\nif (differing > 0) quit(status = 1)\n";
}

} // namespace physvib
