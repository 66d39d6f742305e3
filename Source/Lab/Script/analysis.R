# SPDX-License-Identifier: MIT
# Tests over participants, by R alone. Run in the folder of the report: Rscript analysis.R. Prints each test and writes tests.csv.
script <- sub("^--file=", "", grep("^--file=", commandArgs(FALSE), value = TRUE))
if (length(script) == 1 && basename(script) == "analysis.R") setwd(dirname(script))
options(warn = -1) # R warns of ties in rank tests, where p is not exact, and of names in an appended table

# All cells as text: 01 is not 1, and NA may be a code. The apostrophe before what a spreadsheet would take for a formula goes.
table.of <- function(file) {
  d <- read.csv(file, comment.char = "#", colClasses = "character", check.names = FALSE, encoding = "UTF-8", na.strings = character())
  d[] <- lapply(d, sub, pattern = "^'('*[=+@-])", replacement = "\\1")
  d
}
# The level of a factor in each row: a column, the second part of one (condition.2), a word of condition or stimulus (pair=wood), or a letter of a
# method's name (A of AV-FF-DRV).
level.in <- function(cell, factor) {
  for (word in strsplit(cell, " ", fixed = TRUE)[[1]]) {
    if (startsWith(word, paste0(factor, "="))) return(substring(word, nchar(factor) + 2))
    for (part in strsplit(word, "-", fixed = TRUE)[[1]]) if (part %in% paste0(factor, c("V", "F"))) return(substring(part, nchar(factor) + 1))
  }
  NA_character_
}
level <- function(d, factor) {
  if (factor %in% names(d)) return(d[[factor]])
  column <- sub("\\.[1-9]$", "", factor)
  if (column != factor && column %in% names(d)) return(sapply(strsplit(d[[column]], "-", fixed = TRUE), `[`, as.integer(sub(".*\\.", "", factor))))
  found <- rep(NA_character_, nrow(d))
  for (column in intersect(c("stimulus", "condition"), names(d))) { own <- vapply(d[[column]], level.in, "", factor); found <- ifelse(is.na(own), found, own) }
  unname(found)
}
# The rows of a measure; "choice=RM" is 1 where the column says so, else 0. Trainings and rows without the measure are left out.
rows.of <- function(file, measure, within, where) {
  d <- table.of(file)
  if ("phase" %in% names(d)) d <- d[d$phase != "training", ]
  for (words in where) d <- d[which(level(d, sub("=.*", "", words)) == sub("^[^=]*=", "", words)), ]
  column <- if (measure %in% names(d)) measure else sub("=.*", "", measure)
  d <- d[!(d[[column]] %in% c("", "NA")), ]
  y <- if (measure %in% names(d)) as.numeric(d[[column]]) else as.numeric(d[[column]] == sub("^[^=]*=", "", measure))
  rows <- data.frame(id = d$participant, y = y)
  for (i in seq_along(within)) { own <- level(d, within[i]); rows[[paste0("w", i)]] <- factor(own, levels = unique(own)) }
  rows
}
# A participant per row, a combination of levels per column (the last factor varies fastest): means over rows. Who lacks a combination is left out.
cells.of <- function(rows) {
  cell <- interaction(rows[-(1:2)], sep = ":", lex.order = TRUE)
  means <- tapply(rows$y, list(factor(rows$id, levels = unique(rows$id)), cell), mean)
  means <- means[complete.cases(means), , drop = FALSE]
  if (nrow(means) < 2) stop(paste("expected two or more participants with all levels, found", nrow(means)))
  means
}
by.level <- function(rows, cells, i) { # means over the cells of all other factors
  at <- rev(expand.grid(rev(lapply(rows[-(1:2)], levels))))[[i]]
  sapply(levels(rows[[i + 2]]), function(l) apply(cells[, at == l, drop = FALSE], 1, mean))
}

results <- data.frame()
result <- function(test, effect, statistic, value, p, n, df1 = NA, df2 = NA, p_corrected = NA, correction = "", epsilon = NA, size = "",
                   effect_size = NA, difference = NA, least = NA, most = NA, note = "") {
  line <- data.frame(test, effect, statistic, df1, df2, value, p, p_corrected, correction, epsilon, size, effect_size, n, difference, least, most, note)
  results <<- rbind(results, line)
  near <- function(x) format(signif(x, 4), digits = 4)
  known <- function(words, x) if (is.na(x)) "" else paste0(", ", words, " ", near(x))
  df <- if (is.na(df1)) "" else paste0("(", near(df1), if (!is.na(df2)) paste0(", ", near(df2)), ")")
  interval <- if (is.na(least)) "" else paste0(" (95 % interval ", near(least), " to ", near(most), ")")
  told <- paste0(statistic, df, " = ", near(value), ", p = ", near(p), known(paste(correction, "p ="), p_corrected), known("epsilon", epsilon),
                 known("difference", difference), interval, known(paste(size, "="), effect_size))
  cat("  ", effect, ": ", if (note != "") paste("not tested:", note) else told, ", n = ", n, "\n", sep = "")
}
# A test that R refuses is a line that says why; the others go on.
attempt <- function(test, effect, run) tryCatch(run, error = function(e) result(test, effect, "", NA, NA, NA, note = gsub("\n", "", conditionMessage(e), fixed = TRUE)))

# Repeated measures: each effect by its orthonormal contrasts of the cells, F against its own error; p corrected by Greenhouse and Geisser.
anova.test <- function(test, file, measure, within, where = character()) { cat(test, "\n", sep = ""); attempt(test, "all", {
  rows <- rows.of(file, measure, within, where); cells <- cells.of(rows); n <- nrow(cells)
  contrast <- function(i, effect) {
    k <- nlevels(rows[[i + 2]])
    if (!(i %in% effect)) return(matrix(1 / sqrt(k), k))
    h <- contr.helmert(k)
    h %*% diag(1 / sqrt(colSums(h^2)), k - 1)
  }
  effects <- unlist(lapply(seq_along(within), function(m) combn(length(within), m, simplify = FALSE)), recursive = FALSE)
  contrasts <- lapply(c(list(integer()), effects), function(e) Reduce(kronecker, lapply(seq_along(within), contrast, e)))
  scores <- lapply(contrasts, function(one) cells %*% one)
  error <- lapply(scores, function(s) crossprod(scale(s, scale = FALSE)))
  errors <- sum(sapply(error, function(e) sum(diag(e)))) # of generalised eta squared
  for (i in seq_along(effects)) {
    s <- scores[[i + 1]]; e <- error[[i + 1]]; d <- ncol(s); name <- paste(within[effects[[i]]], collapse = ":")
    squares <- n * sum(colMeans(s)^2); left <- sum(diag(e))
    if (left <= 1e-26 * sum(cells^2)) { result(test, name, "F", NA, NA, n, note = "nobody differs from the others in it"); next }
    f <- squares / (left / (n - 1)); epsilon <- left^2 / (d * sum(e^2))
    p <- function(epsilon) pf(f, epsilon * d, epsilon * d * (n - 1), lower.tail = FALSE)
    corrected <- if (d > 1) list(p(epsilon), "Greenhouse-Geisser", epsilon) else list(NA, "", NA)
    result(test, name, "F", f, p(1), n, d, d * (n - 1), corrected[[1]], corrected[[2]], corrected[[3]], "generalised eta squared", squares / (squares + errors))
    if (d > 1 && n > d) attempt(test, paste(name, "sphericity"), {
      m <- mauchly.test(lm(cells ~ 1), T = t(contrasts[[i + 1]]))
      result(test, paste(name, "sphericity"), "Mauchly W", m$statistic, m$p.value, n)
    })
  }
  for (i in seq_len(ncol(cells))) attempt(test, paste(colnames(cells)[i], "normality"), {
    s <- shapiro.test(cells[, i]); result(test, paste(colnames(cells)[i], "normality"), "Shapiro-Wilk W", s$statistic, s$p.value, n)
  })
}) }
friedman <- function(test, file, measure, within, where = character()) { cat(test, "\n", sep = ""); attempt(test, "all", {
  rows <- rows.of(file, measure, within, where); cells <- cells.of(rows)
  for (i in seq_along(within)) attempt(test, within[i], {
    t <- friedman.test(by.level(rows, cells, i)); n <- nrow(cells)
    if (is.nan(t$p.value)) stop("all levels are tied")
    result(test, within[i], "chi-squared", t$statistic, t$p.value, n, t$parameter, size = "Kendall's W", effect_size = t$statistic / (n * t$parameter))
  })
}) }
# Every two levels of each factor within participants; the correction is for all lines.
pairs.test <- function(test, file, measure, within, where = character(), by = "t", correction = "holm") { cat(test, "\n", sep = ""); attempt(test, "all", {
  rows <- rows.of(file, measure, within, where); cells <- cells.of(rows); n <- nrow(cells)
  tests <- list()
  for (i in seq_along(within)) {
    m <- by.level(rows, cells, i); two <- combn(ncol(m), 2)
    for (k in seq_len(ncol(two))) {
      a <- m[, two[1, k]]; b <- m[, two[2, k]]
      t <- tryCatch(if (by == "t") t.test(a, b, paired = TRUE) else wilcox.test(a, b, paired = TRUE), error = function(e) list(p.value = NaN))
      effect <- paste0(within[i], ": ", colnames(m)[two[1, k]], " - ", colnames(m)[two[2, k]])
      tests[[length(tests) + 1]] <- list(effect = effect, a = a, b = b, t = t)
    }
  }
  ps <- sapply(tests, function(one) one$t$p.value)
  corrected <- p.adjust(ps, correction, length(ps))
  for (k in seq_along(tests)) {
    one <- tests[[k]]; t <- one$t; d <- one$a - one$b
    if (is.nan(ps[k])) result(test, one$effect, "", NA, NA, n, note = "the differences do not vary")
    else if (by == "t") result(test, one$effect, "t", t$statistic, ps[k], n, t$parameter, NA, corrected[k], correction, size = "d", effect_size = mean(d) / sd(d),
                               difference = mean(d), least = t$conf.int[1], most = t$conf.int[2])
    else result(test, one$effect, "V", t$statistic, ps[k], n, p_corrected = corrected[k], correction = correction, size = "rank-biserial r",
                effect_size = 2 * t$statistic / sum(seq_len(sum(d != 0))) - 1, difference = median(d))
  }
  if (by == "t" && n > 1) for (alpha in unique(c(0.05, 0.05 / length(ps)))) attempt(test, "power", {
    found <- power.t.test(n, power = 0.8, sd = 1, sig.level = alpha, type = "paired")$delta
    cat("  power: n = ", n, " finds d = ", round(found, 2), " in 80 % of studies at p < ", signif(alpha, 2), "\n", sep = "")
  })
}) }
# Signed ranks of participants' shares of the first alternative against one half: of all trials, each word of a stimulus or condition, each whole one.
choices <- function(test, file) { cat(test, "\n", sep = ""); attempt(test, "all", {
  d <- table.of(file)
  if ("phase" %in% names(d)) d <- d[d$phase != "training", ]
  if ("task" %in% names(d)) d <- d[d$task == "choose", ]
  if (!("choice" %in% names(d))) d$choice <- d$response
  d <- d[d$choice != "", ]
  words <- sort(unique(d$choice), method = "radix")
  if (length(words) != 2) stop(paste("expected two alternatives that were chosen, found", length(words)))
  kind <- if ("stimulus" %in% names(d)) d$stimulus else if ("condition" %in% names(d)) d$condition else rep("", nrow(d))
  parts <- setdiff(grep("=", unlist(strsplit(kind, " ", fixed = TRUE)), value = TRUE), kind)
  groups <- c("all", if (length(unique(kind)) > 1) c(sort(unique(parts)), sort(unique(kind))))
  tests <- lapply(groups, function(name) {
    of <- name == "all" | kind == name | grepl(paste0(" ", name, " "), paste0(" ", kind, " "), fixed = TRUE)
    hits <- tapply(d$choice[of] == words[1], d$participant[of], sum); n <- tapply(of[of], d$participant[of], length)
    lead <- (2 * hits - n) / n # leads of the same size tie to the bit
    list(share = mean(hits / n), n = length(n), t = if (length(n) > 1 && any(lead != 0)) wilcox.test(lead) else NULL)
  })
  ps <- sapply(tests, function(one) if (is.null(one$t)) NA else one$t$p.value)
  corrected <- p.adjust(ps, "holm")
  for (k in seq_along(groups)) {
    one <- tests[[k]]
    if (is.na(ps[k])) result(test, groups[k], "V", NA, NA, one$n, note = "one participant, or shares of one half alone")
    else result(test, groups[k], "V", one$t$statistic, ps[k], one$n, p_corrected = corrected[k], correction = "holm", size = paste("share of", words[1]),
                effect_size = one$share)
  }
}) }
finish <- function(study) {
  writeLines(paste0("# ", study, ", ", R.version.string), "tests.csv")
  write.table(results, "tests.csv", append = TRUE, sep = ",", row.names = FALSE, na = "", qmethod = "double")
  cat("tests.csv  ", nrow(results), " lines\n", sep = "")
}

