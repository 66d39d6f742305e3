# SPDX-License-Identifier: MIT
# Makes random designs and what R says of them: the tables that Tests/Study/StatisticsTest.cpp reads.
#   Rscript oracle.R COUNT FOLDER [SEED]      writes FOLDER/designs.txt and FOLDER/results.csv
# The tables beside this script: Rscript oracle.R 120 . ; others are made, compared and forgotten by compare.sh, which installs R as well.
suppressMessages({library(afex); library(car); library(rstatix)})
options(warn = -1)
arguments <- commandArgs(TRUE)
count <- as.integer(arguments[1]); folder <- arguments[2]
dir.create(folder, showWarnings = FALSE, recursive = TRUE)
set.seed(if (length(arguments) > 2) as.integer(arguments[3]) else 1)

number <- function(x) ifelse(is.nan(x), "NaN", ifelse(is.na(x), "", ifelse(x == Inf, "?", sprintf("%.13g", x))))
lines <- character()
say <- function(id, test, effect, df1 = NA, df2 = NA, statistic = NA, p = NA, corrected = NA, epsilon = NA, size = NA, n = NA, hf = NA, pHf = NA, w = NA, pW = NA)
  lines <<- c(lines, paste(id, test, effect, number(df1), number(df2), number(statistic), number(p), number(corrected), number(epsilon), number(size), n, number(hf), number(pHf), number(w), number(pW), sep = ","))
refused <- function(id, test) lines <<- c(lines, paste0(id, ",", test, ",refused", strrep(",", 12)))
attempt <- function(id, test, call) {
  before <- lines
  ok <- tryCatch({ call; !any(grepl("NaN", lines[seq_along(lines) > length(before)])) }, error = function(e) FALSE)
  if (!ok) { lines <<- before; refused(id, test) }
}

analysis <- function(data, within, between) suppressMessages(aov_ez("id", "y", data, between = between, within = within, type = 3, include_aov = FALSE,
                                                                    anova_table = list(es = "ges", correction = "none")))
anovaLines <- function(id, test, fit, n, only = NULL) {
  table <- fit$anova_table
  whole <- if (inherits(fit$Anova, "Anova.mlm")) summary(fit$Anova, multivariate = FALSE) else NULL
  for (effect in rownames(table)) {
    if (!is.null(only) && effect != only) next
    row <- table[effect, ]; isWithin <- grepl("[abc]", effect)
    # car leaves effects out whose error matrix is singular (fewer participants than dimensions, as a rule): no figures to compare with
    adjusted <- if (is.null(whole) || !isWithin || dimensions(fit, effect) < 2) NULL else
      if (effect %in% rownames(whole$sphericity.tests)) whole$pval.adjustments[effect, ] else
      c("GG eps" = Inf, "Pr(>F[GG])" = Inf, "HF eps" = Inf, "Pr(>F[HF])" = Inf)
    mauchly <- if (!is.null(adjusted) && effect %in% rownames(whole$sphericity.tests)) whole$sphericity.tests[effect, ] else c(NA, NA)
    p <- row[["Pr(>F)"]]; size <- row[["ges"]]
    if (!is.null(whole)) {
      squares <- whole$univariate.tests
      if (any(squares[, "Error SS"] < 1e-12 * max(squares))) stop("an effect that is the same for everyone has F of rounding") # negative, 1e14 ...
      # afex adds up what differs of the errors' sums of squares: two errors of the same size count once, which is not the formula
      errors <- squares[!duplicated(gsub("[^abc]", "", sub("(Intercept)", "", rownames(squares), fixed = TRUE))), "Error SS"]
      if (length(unique(errors)) < length(errors)) size <- squares[effect, "Sum Sq"] / (squares[effect, "Sum Sq"] + sum(errors))
    }
    say(id, test, effect, row[["num Df"]], row[["den Df"]], row[["F"]], p,
        if (is.null(adjusted)) p else adjusted[["Pr(>F[GG])"]], if (is.null(adjusted)) (if (isWithin) 1 else NA) else adjusted[["GG eps"]], size, n,
        if (is.null(adjusted)) NA else adjusted[["HF eps"]], if (is.null(adjusted)) NA else adjusted[["Pr(>F[HF])"]], mauchly[[1]], mauchly[[2]])
  }
}
dimensions <- function(fit, effect) {
  parts <- setdiff(strsplit(effect, ":")[[1]], "g")
  prod(sapply(parts, function(f) length(unique(fit$data$long[[f]])) - 1))
}
marginal <- function(data, factors) if (length(factors) == 0) rep(mean(data$y), nrow(data)) else do.call(ave, c(list(data$y), unname(as.list(data[factors]))))
subsets <- function(s) unlist(lapply(0:length(s), function(m) combn(s, m, simplify = FALSE)), recursive = FALSE)
aligned <- function(data, all, effect) {
  y <- data$y - marginal(data, all)
  for (part in subsets(effect)) y <- y + (-1)^(length(effect) - length(part)) * marginal(data, part)
  rank(round(y / max(abs(y)) * 1e10))
}

makeDesign <- function(id) {
  kind <- id %% 10
  levels <- switch(kind + 1, sample(2:6, 1), sample(2:6, 1), sample(2:6, 1), sample(2:4, 2, TRUE), sample(2:6, 2, TRUE), sample(2:3, 3, TRUE), sample(2:6, 1),
                   sample(2:3, sample(2:3, 1), TRUE), integer(), integer())
  groups <- if (kind %in% 6:7) sample(2:3, 1) else if (kind == 8) 2 else if (kind == 9) sample(2:6, 1) else 0
  n <- if (runif(1) < 0.05 && length(levels) < 2) sample(49:70, 1) else sample(3:40, 1)
  n <- max(n, groups + 2)
  cells <- max(1, prod(levels))
  group <- if (groups > 0) c(seq_len(groups), sample(seq_len(groups), n - groups, TRUE)) else NULL
  y <- matrix(rnorm(n * cells), n) + rnorm(n) + rep(rnorm(cells) * runif(1, 0, 1.5), each = n)
  if (runif(1) < 0.3) y <- y + matrix(rnorm(n * cells), n) %*% diag(runif(cells, 0, 2), cells)
  if (groups > 0) y <- y + rnorm(groups)[group] * runif(1)
  if (runif(1) < 0.2) y <- exp(y)
  y <- if (runif(1) < 0.4) round(2 * y) else round(y, 3)
  if (cells > 1 && runif(1) < 0.3) y[-1, ][matrix(runif((n - 1) * cells) < 0.02, n - 1)] <- NA # the first participant shows the levels in their order
  list(levels = levels, group = group, y = y)
}

designs <- character()
for (id in seq_len(count)) {
  design <- makeDesign(id)
  levels <- design$levels; group <- design$group; y <- design$y
  designs <- c(designs, paste(id, if (length(levels)) paste(levels, collapse = "x") else "-", if (is.null(group)) "-" else paste(group, collapse = ""),
                              paste(ifelse(is.na(t(y)), "NA", format(t(y), digits = 15, trim = TRUE, drop0trailing = TRUE)), collapse = ",")))
  n <- nrow(y); cells <- ncol(y)
  within <- c("a", "b", "c")[seq_along(levels)]
  data <- data.frame(id = factor(rep(seq_len(n), each = cells)), y = as.vector(t(y)))
  if (length(within)) {
    grid <- expand.grid(rev(lapply(levels, seq_len)))[, rev(seq_along(levels)), drop = FALSE]
    for (f in seq_along(levels)) data[[within[f]]] <- factor(rep(grid[[f]], n))
  }
  if (!is.null(group)) data$g <- factor(rep(group, each = cells))
  whole <- complete.cases(y)
  y <- y[whole, , drop = FALSE]; data <- data[rep(whole, each = cells), ]; data$id <- droplevels(data$id)
  if (!is.null(group)) { group <- group[whole]; data$g <- droplevels(data$g) }
  n <- nrow(y)
  between <- if (is.null(group)) NULL else "g"
  all <- c(between, within)
  attempt(id, "anova", anovaLines(id, "anova", analysis(data, if (length(within)) within else NULL, between), n))
  if (length(all) > 1 && id %% 3 == 0) attempt(id, "aligned", {
    for (m in fitOrder <- rownames(analysis(data, within, between)$anova_table)) {
      ranked <- data; ranked$y <- aligned(data, all, strsplit(m, ":")[[1]])
      anovaLines(id, "aligned", analysis(ranked, within, between), n, m)
    }
  })
  if (length(within) == 1 && is.null(between)) {
    k <- cells
    attempt(id, "friedman", { t <- friedman.test(y); say(id, "friedman", "a", t$parameter, NA, t$statistic, t$p.value, size = t$statistic / (n * (k - 1)), n = n) })
    if (k == 2) attempt(id, "wilcoxon", {
      t <- wilcox.test(y[, 1], y[, 2], paired = TRUE); d <- y[, 1] - y[, 2]; m <- sum(d != 0)
      say(id, "wilcoxon", "a", statistic = t$statistic, p = t$p.value, size = 2 * t$statistic / sum(seq_len(m)) - 1, n = n)
    })
    two <- combn(k, 2)
    attempt(id, "pairs-t", {
      tests <- apply(two, 2, function(i) { t <- t.test(y[, i[1]], y[, i[2]], paired = TRUE); d <- y[, i[1]] - y[, i[2]]; c(t$parameter, t$statistic, t$p.value, mean(d) / sd(d)) })
      corrected <- p.adjust(tests[3, ], "holm")
      for (i in seq_len(ncol(two))) say(id, "pairs-t", paste0("a: ", two[1, i], " - ", two[2, i]), tests[1, i], NA, tests[2, i], tests[3, i], corrected[i], size = tests[4, i], n = n)
    })
    attempt(id, "pairs-ranks", {
      tests <- apply(two, 2, function(i) { t <- wilcox.test(y[, i[1]], y[, i[2]], paired = TRUE); m <- sum(y[, i[1]] != y[, i[2]]); c(t$statistic, t$p.value, 2 * t$statistic / sum(seq_len(m)) - 1) })
      corrected <- p.adjust(tests[2, ], "bonferroni")
      for (i in seq_len(ncol(two))) say(id, "pairs-ranks", paste0("a: ", two[1, i], " - ", two[2, i]), statistic = tests[1, i], p = tests[2, i], corrected = corrected[i], size = tests[3, i], n = n)
    })
    attempt(id, "shapiro", for (i in seq_len(k)) { t <- shapiro.test(y[, i]); say(id, "shapiro", paste0("a=", i), statistic = t$statistic, p = t$p.value, n = n) })
  }
  if (length(within) == 0) {
    values <- split(y[, 1], group); two <- combn(length(values), 2)
    attempt(id, "kruskal-wallis", {
      t <- kruskal.test(values); frame <- data.frame(y = y[, 1], g = group)
      say(id, "kruskal-wallis", "g", t$parameter, NA, t$statistic, t$p.value, size = kruskal_effsize(frame, y ~ g)$effsize, n = n)
    })
    if (length(values) == 2) attempt(id, "mann-whitney", {
      t <- wilcox.test(values[[1]], values[[2]])
      say(id, "mann-whitney", "g", statistic = t$statistic, p = t$p.value, size = 2 * t$statistic / prod(lengths(values)) - 1, n = n)
    })
    attempt(id, "pairs-t", {
      tests <- apply(two, 2, function(i) { a <- values[[i[1]]]; b <- values[[i[2]]]; t <- t.test(a, b); c(t$parameter, t$statistic, t$p.value, (mean(a) - mean(b)) / sqrt((var(a) + var(b)) / 2), length(a) + length(b)) })
      corrected <- p.adjust(tests[3, ], "holm")
      for (i in seq_len(ncol(two))) say(id, "pairs-t", paste0("g: ", two[1, i], " - ", two[2, i]), tests[1, i], NA, tests[2, i], tests[3, i], corrected[i], size = tests[4, i], n = tests[5, i])
    })
    attempt(id, "pairs-ranks", {
      tests <- apply(two, 2, function(i) { a <- values[[i[1]]]; b <- values[[i[2]]]; t <- wilcox.test(a, b); c(t$statistic, t$p.value, 2 * t$statistic / length(a) / length(b) - 1, length(a) + length(b)) })
      corrected <- p.adjust(tests[2, ], "bonferroni")
      for (i in seq_len(ncol(two))) say(id, "pairs-ranks", paste0("g: ", two[1, i], " - ", two[2, i]), statistic = tests[1, i], p = tests[2, i], corrected = corrected[i], size = tests[3, i], n = tests[4, i])
    })
  }
}
writeLines(c("# id, levels of the within-factors a, b, c, group of each participant, values participant by participant", designs), file.path(folder, "designs.txt"))
writeLines(c(paste("#", R.version.string, "afex", packageVersion("afex"), "car", packageVersion("car"), "rstatix", packageVersion("rstatix")),
             "id,test,effect,df1,df2,statistic,p,p_corrected,epsilon,effect_size,n,epsilon_hf,p_hf,mauchly_w,mauchly_p", lines), file.path(folder, "results.csv"))
