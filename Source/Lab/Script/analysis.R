# SPDX-License-Identifier: MIT
# Tests over participants, by R alone. Run in the folder of the report: Rscript analysis.R writes tests.csv. `study` at the end
# says which measures there are; what is tested follows from the measure and from the factors that its rows have, here and nowhere else.
script <- sub("^--file=", "", grep("^--file=", commandArgs(FALSE), value = TRUE))
if (length(script) == 1 && basename(script) == "analysis.R") setwd(dirname(script))
options(warn = -1) # R warns of ties in rank tests, where p is not exact, and of names in an appended table

# All cells as text: 01 is not 1, and NA may be a code, though of no group. The apostrophe before what a spreadsheet would take for a formula goes.
# A participant's group stands in the rows, in participants.csv, or in the trials that a table is of. Trainings, and trials that did not leave, are left out.
table.of <- function(file) {
  read <- function(file) {
    d <- read.csv(file, comment.char = "#", colClasses = "character", check.names = FALSE, encoding = "UTF-8", na.strings = character())
    d[] <- lapply(d, sub, pattern = "^'('*[=+@-])", replacement = "\\1")
    d
  }
  d <- read(file)
  for (others in setdiff(c("participants.csv", "trials.csv"), file)) # nothing is read twice
    if (!("group" %in% names(d)) && "participant" %in% names(d) && file.exists(others) && all(c("participant", "group") %in% names(people <- read(others))))
      d$group <- people$group[match(d$participant, people$participant)]
  if ("group" %in% names(d)) d$group[d$group %in% "NA"] <- ""
  if ("phase" %in% names(d)) d <- d[d$phase != "training", ]
  if ("left" %in% names(d)) d <- d[d$left != "0", ]
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
  found <- rep(NA_character_, nrow(d))
  for (column in intersect(c("stimulus", "condition"), names(d))) {
    cells <- unique(d[[column]]); own <- vapply(cells, level.in, "", factor)[match(d[[column]], cells)]
    found <- ifelse(is.na(own), found, own)
  }
  if (nrow(d) > 0 && !anyNA(found)) return(unname(found)) # a word, though a column may have its name
  if (factor %in% names(d)) return(d[[factor]])
  column <- sub("\\.[1-9]$", "", factor)
  if (column != factor && column %in% names(d)) return(sapply(parts.of(d[[column]]), `[`, as.integer(sub(".*\\.", "", factor))))
  unname(found)
}
parts.of <- function(cells) { # PHONE-3x3, index_60Hz, grit=60 wet
  for (between in c("-", "_", " ")) { parts <- strsplit(cells, between, fixed = TRUE); if (all(lengths(parts) == 2)) break }
  parts
}
in.order <- function(levels) { # numbers by size
  levels <- sort(unique(levels), method = "radix"); numbers <- suppressWarnings(as.numeric(levels))
  if (anyNA(numbers)) levels else levels[order(numbers)]
}
# The rows of a measure; "choice=RM" is 1 where the column says so, else 0. Rows without the measure are left out.
where.is <- function(d, where) { for (words in where) d <- d[which(level(d, sub("=.*", "", words)) == sub("^[^=]*=", "", words)), ]; d }
# Whose group is not known, or who is in several where most are in one, is in no test of a model that has it.
rows.of <- function(file, measure, factors, where = character(), between = character()) {
  d <- if (is.data.frame(file)) file else table.of(file)
  d <- where.is(d, where)
  unknown <- if ("group" %in% between) groupless(d)
  d <- d[!(d$participant %in% unknown), ]
  all <- c(attr(file, "absent"), d$participant)
  column <- if (measure %in% names(d)) measure else sub("=.*", "", measure)
  d <- d[!no.value(d, column, measure), ]
  if (startsWith(measure, "choice=") && length(unique(offered.of(d))) > 1) stop("not comparable: other alternatives were offered")
  y <- if (measure %in% names(d)) suppressWarnings(as.numeric(d[[column]])) else as.numeric(d[[column]] == sub("^[^=]*=", "", measure))
  if (anyNA(y)) stop(paste0("expected numbers in the column ", column, ", found ", d[[column]][is.na(y)][1]))
  rows <- data.frame(id = d$participant, y = y)
  for (i in seq_along(factors)) { own <- level(d, factors[i]); rows[[paste0("w", i)]] <- factor(own, levels = in.order(own)) }
  structure(rows, unknown = unknown, absent = setdiff(all, c(rows$id, unknown)))
}
no.value <- function(d, column, measure = column) d[[column]] %in% c("", if (measure %in% names(d) && !(column %in% c("choice", "response"))) "NA") # an answer may be called NA
groupless <- function(d) {
  several <- tapply(d$group, d$participant, function(g) length(unique(g)) > 1)
  none <- unique(d$participant[d$group %in% c("", NA)]); both <- setdiff(if (isTRUE(mean(several) < 0.5)) names(which(several)), none)
  setNames(c(none, both), paste0(c(none, both), rep(c(" (group not known)", " (in several groups)"), c(length(none), length(both)))))
}
# A participant per row, a combination of levels per column (the last factor varies fastest): means over rows. Who lacks a combination is left out.
cells.of <- function(rows) {
  id <- factor(rows$id, levels = unique(rows$id))
  cell <- if (ncol(rows) > 2) interaction(rows[-(1:2)], sep = ":", lex.order = TRUE) else factor(rep("all", nrow(rows)))
  means <- tapply(rows$y, list(id, cell), mean)
  whole <- complete.cases(means)
  if (sum(whole) < 2) stop(paste("expected two or more participants with all levels, found", sum(whole)))
  structure(means[whole, , drop = FALSE], lacking = rownames(means)[!whole], unknown = attr(rows, "unknown"), absent = attr(rows, "absent"))
}
# Values whose ranks are asked for: means that differ by the rounding of thirds are the same.
even <- function(x, size = max(abs(x), 1e-300)) round(x / size, 9)
by.level <- function(rows, cells, i) { # means over the cells of all other factors
  at <- rev(expand.grid(rev(lapply(rows[-(1:2)], levels))))[[i]]
  sapply(levels(rows[[i + 2]]), function(l) apply(cells[, at == l, drop = FALSE], 1, mean))
}
of.people <- function(file, measure, factor, people, where = character()) { # the level that each of them has alone
  rows <- rows.of(file, measure, factor, where)
  factor(as.character(rows$w1)[match(people, rows$id)])
}

results <- data.frame()
# A line of tests.csv. `kind`: a test, an assumption of one, a mean of a level, what was left out or averaged over (note), or why there is no test (not made).
result <- function(test, effect, statistic, value, p, n, df1 = NA, df2 = NA, p_corrected = NA, correction = "", epsilon = NA, size = "",
                   effect_size = NA, difference = NA, least = NA, most = NA, note = "", kind = if (is.na(p)) "not made" else "test")
  results <<- rbind(results, data.frame(kind, test, effect, statistic, df1, df2, value, p, p_corrected, correction, epsilon, size, effect_size, n, difference, least, most, note,
                                        p_across = NA, across = ""))
remark <- function(test, effect, n, note) result(test, effect, "", NA, NA, n, note = note, kind = "note")
counted <- function(n, word) paste0(n, " ", word, if (n != 1) "s")
# Signed ranks, or of two arguments Mann and Whitney's: p of all signs, or of all ways to divide the ranks, also where they are tied. Of more ranks R's own.
rank.test <- function(a, b = NULL) {
  t <- if (is.null(b)) wilcox.test(a) else wilcox.test(a, b)
  d <- if (is.null(b)) a[a != 0] else c(a, b)
  if (is.nan(t$p.value) || length(d) > 60) return(t)
  ranks <- as.integer(round(2 * rank(if (is.null(b)) abs(d) else d))); sums <- sum(ranks) + 1; chosen <- if (is.null(b)) d > 0 else seq_along(d) <= length(a)
  ways <- matrix(0, length(d) + 1, sums); ways[1, 1] <- 1 # by number of ranks chosen and their sum
  for (r in ranks) ways[-1, (r + 1):sums] <- ways[-1, (r + 1):sums] + ways[-nrow(ways), 1:(sums - r)]
  ways <- if (is.null(b)) colSums(ways) else ways[length(a) + 1, ]
  at <- sum(ranks[chosen]) + 1
  t$p.value <- min(1, 2 * min(sum(ways[1:at]), sum(ways[at:sums])) / sum(ways)); t$method <- "ranks, exact"
  t
}
fewest.different <- 3 # people whose ranks say anything of all
do.differ.few <- function(differ) sum(differ) < min(fewest.different, length(differ))
few.differ <- function(differ) paste("of", length(differ), "people", sum(differ), if (sum(differ) == 1) "differs" else "differ", "between the levels: expected", fewest.different, "or more")
# What a test by ranks did not count, and how it came to its p.
ranks.note <- function(t, equal, words) paste(c(if (equal > 0) paste0(words, ": ", equal), if (grepl("rank", t$method)) if (grepl("exact", t$method)) "exact p, twice the smaller tail" else "p by normal approximation"), collapse = "; ")
# A test that R refuses is a line that says why; the others go on.
attempt <- function(test, effect, run) tryCatch(run, error = function(e) result(test, effect, "", NA, NA, NA, note = gsub("\n", "", conditionMessage(e), fixed = TRUE)))
values.lacking <- function(people) paste("values are lacking of", paste(people, collapse = ", "))
tell.lacking <- function(test, cells) { # once of the same cells
  lacking <- c(attr(cells, "lacking"), attr(cells, "absent")); unknown <- attr(cells, "unknown")
  of <- function(test) sub(" by [^ ]+(, [^ ]+)*$", "", sub("^(analysis of variance|.* test|pairs by (t|ranks)) of ", "", test))
  if (any(results$effect == "left out" & of(results$test) == of(test))) return(invisible())
  if (length(unknown) > 0) remark(test, "left out", nrow(cells), paste0(paste(names(unknown), collapse = ", "), ": left out of tests by group and of those within people beside it"))
  if (length(lacking) > 0) remark(test, "left out", nrow(cells), values.lacking(lacking))
}

# Which factors each effect of a full model has, in the order in which R numbers its terms: A:B, A:C, B:C, A:D.
effects.of <- function(names) lapply(strsplit(attr(terms(as.formula(paste("~", paste(names, collapse = "*")))), "term.labels"), ":", fixed = TRUE), match, names)
# Means of participants' cells, within and between them: each effect by its orthonormal contrasts of the cells, against its own error; between people by
# sums of squares of type III. p is corrected by Greenhouse and Geisser.
anova.test <- function(test, file, measure, within = character(), where = character(), between = character()) { attempt(test, "all", {
  rows <- rows.of(file, measure, within, where, between); cells <- cells.of(rows); n <- nrow(cells)
  tell.lacking(test, cells)
  people <- setNames(lapply(between, function(b) of.people(file, measure, b, rownames(cells), where)), sprintf("b%d", seq_along(between)))
  x <- if (length(between) > 0) model.matrix(as.formula(paste("~", paste(names(people), collapse = "*"))), as.data.frame(people), lapply(people, function(f) "contr.sum"))
       else matrix(1, n, 1)
  terms <- if (length(between) > 0) attr(x, "assign") else 0
  labels <- c("", if (length(between) > 0) vapply(effects.of(names(people)), function(e) paste(between[e], collapse = ":"), ""))
  if (length(between) > 0) remark(test, "model", n, "sums of squares of type III, sum contrasts")
  left.df <- n - qr(x)$rank
  if (left.df < 1) stop("expected more people than groups")
  contrast <- function(i, effect) {
    k <- nlevels(rows[[i + 2]])
    if (!(i %in% effect)) return(matrix(1 / sqrt(k), k))
    h <- contr.helmert(k)
    h %*% diag(1 / sqrt(colSums(h^2)), k - 1)
  }
  effects <- c(list(integer()), unlist(lapply(seq_along(within), function(m) combn(length(within), m, simplify = FALSE)), recursive = FALSE))
  contrasts <- lapply(effects, function(e) Reduce(kronecker, lapply(seq_along(within), contrast, e), matrix(1)))
  scores <- lapply(contrasts, function(one) cells %*% one)
  left.of <- function(s, x) if (ncol(x) > 0) crossprod(lm.fit(x, s)$residuals) else crossprod(s)
  error <- lapply(scores, left.of, x)
  errors <- sum(sapply(error, function(e) sum(diag(e)))) # of generalised eta squared
  for (i in seq_along(effects)) {
    s <- scores[[i]]; e <- error[[i]]; d <- ncol(s); own <- paste(within[effects[[i]]], collapse = ":"); left <- sum(diag(e)); epsilon <- left^2 / (d * sum(e^2))
    for (t in unique(terms)) {
      if (i == 1 && t == 0) next # the mean of all
      name <- paste(c(labels[t + 1], own)[nzchar(c(labels[t + 1], own))], collapse = ":")
      if (left <= 1e-26 * sum(cells^2)) { result(test, name, "F", NA, NA, n, note = "nobody differs from the others in it"); next }
      df <- d * sum(terms == t)
      squares <- sum(diag(left.of(s, x[, terms != t, drop = FALSE]))) - left
      f <- (squares / df) / (left / (d * left.df))
      p <- function(epsilon) pf(f, epsilon * df, epsilon * d * left.df, lower.tail = FALSE)
      corrected <- if (d > 1) list(p(epsilon), "Greenhouse-Geisser", epsilon) else list(NA, "", NA)
      result(test, name, "F", f, p(1), n, df, d * left.df, corrected[[1]], corrected[[2]], corrected[[3]], "generalised eta squared", squares / (squares + errors))
    }
    if (d > 1 && left.df >= d) attempt(test, paste(own, "sphericity"), {
      m <- mauchly.test(lm(cells ~ x - 1), T = t(contrasts[[i]]))
      if (is.nan(m$p.value)) stop("nobody differs from the others in it")
      result(test, paste(own, "sphericity"), "Mauchly W", m$statistic, m$p.value, n, kind = "assumption", note = "p as R's mauchly.test has it")
    })
  }
  if (length(between) > 0) attempt(test, "groups homogeneity", {
    cell <- interaction(people); own <- rowMeans(cells); away <- abs(own - ave(own, cell, FUN = median)); a <- anova(lm(away ~ cell))
    if (a[2, 2] > 1e-20 * sum(away^2)) result(test, "groups homogeneity", "Levene's F of medians", round(a[1, 4], 12), a[1, 5], n, a[1, 1], a[2, 1], kind = "assumption")
  })
  of <- if (length(between) > 0) ", as deviations from the group's mean"
  normality <- if (ncol(cells) > 2) "residuals normality" else paste0("normality of the ", if (ncol(cells) == 2) "differences" else "participants' means", of)
  attempt(test, normality, {
    left <- as.matrix(lm.fit(x, cells)$residuals)
    shapiro <- function(effect, left) { if (max(abs(left)) <= 1e-12 * max(abs(cells), 1e-300)) stop("nobody differs from the others in it"); s <- shapiro.test(left); result(test, effect, "Shapiro-Wilk W", s$statistic, s$p.value, n, kind = "assumption", note = if (length(left) > n) paste("residuals:", length(left)) else "") }
    # of two cells the differences: what is left of both of them is the same with two signs
    shapiro(normality, if (ncol(cells) == 2) left[, 1] - left[, 2] else left - rowMeans(left) * (ncol(cells) > 1))
    if (length(between) > 0 && ncol(cells) > 1) shapiro(paste0("normality of the participants' means", of), rowMeans(left))
  })
  if (length(attr(cells, "lacking")) > 0) attempt(paste0(secondary, test), "all", if (requireNamespace("lme4", quietly = TRUE)) mixed(test, file, measure, within, between, where)
                                                                  else stop("the package lme4, for a model of all people, is not here"))
}) }
# Where people lack levels, secondary to the analysis of those who have all, all people in one model (lme4): each effect by the likelihood ratio of the model with and without it. People differ in
# the effects of several factors within them, too: with an intercept alone 16 of 100 studies without an effect would have one at 0.05.
secondary <- "mixed model beside "; is.secondary <- function(test) startsWith(as.character(test), secondary)
mixed <- function(test, file, measure, within, between, where) {
  test <- paste0(secondary, test)
  factors <- c(within, between)
  d <- aggregate(y ~ ., rows.of(file, measure, factors, where, between), mean)
  own <- names(d)[-c(1, ncol(d))]
  x <- model.matrix(as.formula(paste("~", paste(own, collapse = "*"))), d, lapply(d[own], function(f) "contr.sum"))
  terms <- attr(x, "assign"); effects <- effects.of(own)
  several <- unlist(lapply(seq_len(length(within) - 1), function(m) combn(length(within), m, simplify = FALSE)), recursive = FALSE) # all of them are what is left
  random <- function(id, names) c(id, vapply(several, function(i) paste(c(id, names[i]), collapse = ":"), ""))
  parts <- setNames(random("participant", within), random("id", sprintf("w%d", seq_along(within))))
  remark(test, "model", length(unique(d$id)), paste0("of all who have a value", if ("group" %in% between) " and a known group", ", secondary; ", "maximum likelihood, likelihood ratio of the models with and without the effect, sum contrasts, random ", paste0("(1 | ", parts, ")", collapse = " + ")))
  model <- as.formula(paste("y ~ 0 + x +", paste0("(1 | ", names(parts), ")", collapse = " + ")))
  fit <- function(x) {
    m <- suppressMessages(lme4::lmer(model, c(d, list(x = x)), REML = FALSE)); variances <- vapply(lme4::VarCorr(m), `[`, 0, 1)
    list(l = as.numeric(logLik(m)), zero = parts[names(variances)[variances <= 1e-4 * sigma(m)^2]], failed = any(grepl("converge", unlist(m@optinfo$conv$lme4$messages))))
  }
  all <- fit(x); singular <- function(zero, which) if (length(zero) > 0) paste("variance of", paste(zero, collapse = " and of "), "estimated as 0 in the model", which)
  for (t in seq_along(effects)) { label <- paste(factors[effects[[t]]], collapse = ":"); attempt(test, label, {
    without <- paste("without", label); less <- fit(x[, terms != t, drop = FALSE]); chi <- max(0, 2 * (all$l - less$l))
    error <- paste(c("id", own[intersect(effects[[t]], seq_along(within))]), collapse = ":") # the highest effect within people has the residual
    if (error %in% names(c(all$zero, less$zero))) stop("variance of ", parts[[error]], ", its error, is estimated as 0 in the model ", if (error %in% names(all$zero)) "with all effects" else without)
    result(test, label, "chi-squared", chi, pchisq(chi, sum(terms == t), lower.tail = FALSE), length(unique(d$id)), sum(terms == t),
           note = paste(c("chi-squared approximation", if (setequal(all$zero, less$zero)) singular(all$zero, "with it and in that without") else c(singular(all$zero, "with all effects"), singular(less$zero, without)), if (all$failed || less$failed) "did not converge"), collapse = ", "))
  }) }
}
friedman <- function(test, file, measure, within = character(), where = character(), between = character(), tested = c(within, between)) { attempt(test, "all", {
  rows <- rows.of(file, measure, within, where, between); cells <- cells.of(rows); n <- nrow(cells)
  tell.lacking(test, cells)
  for (i in which(within %in% tested)) attempt(test, within[i], {
    own <- even(by.level(rows, cells, i)); differ <- apply(own, 1, function(y) any(y != y[1]))
    t <- friedman.test(own)
    if (is.nan(t$p.value)) stop("all levels are tied")
    if (do.differ.few(differ)) stop(few.differ(differ))
    result(test, within[i], "chi-squared", t$statistic, t$p.value, n, t$parameter, size = "Kendall's W", effect_size = t$statistic / (n * t$parameter))
  })
  for (b in intersect(between, tested)) attempt(test, b, {
    t <- kruskal.test(even(rowMeans(cells)), of.people(file, measure, b, rownames(cells), where))
    if (is.nan(t$p.value)) stop("all people are tied")
    result(test, b, "chi-squared", t$statistic, t$p.value, n, t$parameter)
  })
}) }
# Every two levels of each factor, within participants or between them; the correction is for all lines of a factor. Ranks of levels within are signed
# ranks of differences, or, not `paired`, those of Mann and Whitney, as if other people had given each level.
pairs.test <- function(test, file, measure, within = character(), where = character(), by = "t", correction = "holm", between = character(), paired = TRUE) { attempt(test, "all", {
  rows <- rows.of(file, measure, within, where, between); cells <- cells.of(rows); n <- nrow(cells)
  tell.lacking(test, cells)
  if (by == "t" && length(between) > 0 && n <= nlevels(interaction(lapply(between, function(b) of.people(file, measure, b, rownames(cells), where)), drop = TRUE))) stop("expected more people than groups")
  for (f in c(within, between)) {
    is.within <- f %in% within; is.signed <- is.within && paired
    own <- if (is.within) by.level(rows, cells, match(f, within)) else split(unname(rowMeans(cells)), of.people(file, measure, f, rownames(cells), where))
    two <- combn(names(if (is.within) as.data.frame(own, optional = TRUE) else own), 2, simplify = FALSE)
    level.of <- function(l) if (is.within) own[, l] else own[[l]]
    groups <- if (is.within && length(between) > 0) interaction(lapply(between, function(b) of.people(file, measure, b, rownames(cells), where)), drop = TRUE)
    deviation <- if (!is.within) sqrt(sum(sapply(own, function(y) sum((y - mean(y))^2))) / (n - length(own))) # of all groups
    tests <- lapply(two, function(l) {
      a <- level.of(l[1]); b <- level.of(l[2])
      if (by == "t" && !is.within) {
        se <- deviation * sqrt(1 / length(a) + 1 / length(b)); df <- n - length(own); t <- (mean(a) - mean(b)) / se
        return(list(p = 2 * pt(-abs(t), df), value = t, df = df, size = "d", effect = (mean(a) - mean(b)) / deviation, difference = mean(a) - mean(b),
                    interval = mean(a) - mean(b) + c(-1, 1) * qt(0.975, df) * se, n = length(a) + length(b),
                    note = if (length(own) > 2) paste("pooled SD of all", n)))
      }
      if (by == "t" && nlevels(groups) > 1) { # as the analysis of variance has it: each group counts alike
        m <- lm(a - b ~ groups, contrasts = list(groups = "contr.sum")); s <- coef(summary(m))[1, ]; df <- m$df.residual
        if (sum(m$residuals^2) <= 1e-26 * sum(a^2 + b^2)) return(list(p = NaN, n = n))
        return(list(p = s[[4]], value = s[[3]], df = df, size = "d_z", effect = s[[1]] / sigma(m), difference = s[[1]], interval = s[[1]] + c(-1, 1) * qt(0.975, df) * s[[2]], n = n,
                    note = "unweighted mean of the groups; SD within groups"))
      }
      size <- max(abs(c(a, b)), 1e-300); different <- if (is.signed) even(a - b, size)
      t <- tryCatch(if (by == "t") t.test(a, b, paired = TRUE) else if (is.signed) rank.test(different) else rank.test(even(a, size), even(b, size)), error = function(e) list(p.value = NaN))
      out <- list(p = t$p.value, value = t$statistic, df = NA, size = "rank-biserial r", interval = c(NA, NA), n = if (is.within) n else length(a) + length(b))
      if (is.signed && by == "ranks" && any(different != 0) && do.differ.few(different != 0)) out[c("p", "note")] <- list(NaN, few.differ(different != 0))
      if (is.nan(out$p)) return(out)
      if (by == "t") return(modifyList(out, list(df = t$parameter, size = "d_z", effect = mean(a - b) / sd(a - b), difference = mean(a - b), interval = t$conf.int)))
      share <- if (is.signed) t$statistic / sum(seq_len(sum(different != 0))) else t$statistic / (length(a) * length(b))
      modifyList(out, list(effect = 2 * share - 1, difference = if (is.signed) median(a - b) else even(median(a) - median(b), size) * size,
                           note = paste0(ranks.note(t, if (is.signed) sum(different == 0) else 0, "differences of 0"), if (is.signed) "; difference: median of the differences" else "; difference: of the medians")))
    })
    ps <- sapply(tests, function(one) one$p)
    corrected <- p.adjust(ps, correction); tested <- sum(!is.nan(ps)) # a pair that cannot be tested is no chance of a false finding
    family <- paste0(c(holm = "Holm, ", bonferroni = "Bonferroni, ")[correction], counted(tested, "test"))
    for (l in unique(unlist(two))) { y <- level.of(l); result(sub("^pairs by [a-z]+", "levels", test), paste0(f, "=", l), if (by == "t") "mean" else "median", if (by == "t") mean(y) else median(y), NA, length(y),
      size = if (by == "t") "SD" else "", effect_size = if (by == "t" && length(y) > 1) sd(y) else NA, kind = "mean") }
    for (k in seq_along(tests)) {
      one <- tests[[k]]; effect <- paste0(f, ": ", two[[k]][1], " - ", two[[k]][2])
      if (is.nan(ps[k])) result(test, effect, "", NA, NA, one$n, note = c(one$note, "the differences do not vary")[1])
      else result(test, effect, if (by == "t") "t" else if (is.signed) "V" else "W", one$value, ps[k], one$n, one$df, NA, corrected[k], family, size = one$size,
                  effect_size = one$effect, difference = one$difference, least = one$interval[1], most = one$interval[2], note = c(one$note, "")[1])
    }
  }
}) }
# Whether a participant has more trials of one combination of levels than of another, so that a mean over trials is none over levels.
has.unequal <- function(d, factors) any(tapply(do.call(paste, c(list(character(nrow(d))), lapply(factors, function(f) level(d, f)), sep = "\r")), d$participant, function(own) length(unique(table(own)))) > 1)
over.trials <- function(factors) paste0(if (length(factors) > 1) "combinations of ", paste(factors, collapse = ", "), ": unequal numbers of trials; a participant's share is over all of them, so that those with more count more")
# Participants' shares of an alternative against chance: of all trials, each level of a factor, each combination of levels. Signed ranks; where all lean
# equally far, as where they are unanimous, exact binomials of how many lean to it. Of each alternative the trials count that offered it.
choices <- function(test, file, factors = NULL, where = character()) { attempt(test, "all", {
  d <- where.is(if (is.data.frame(file)) file else table.of(file), where)
  if ("task" %in% names(d)) d <- d[d$task == "choose", ]
  if (!("choice" %in% names(d))) d$choice <- d$response
  d <- d[d$choice != "", ]
  d$offered <- offered.of(d); sets <- in.order(d$offered); words <- words.in(sets)
  if (any(sets == "")) stop("which alternatives were offered is not known: no stimulus has all answers, nor has each as many")
  if (length(words) < 2) stop(paste("expected two alternatives or more, found", length(words)))
  for (s in sets) remark(test, "chance", length(unique(d$participant[d$offered == s])), paste0("1 of ", length(words.in(s)), ", ", if (any(parts.offered(d) != "")) "offered" else if (length(sets) > 1) "answers to a stimulus" else "answers given",
                             ": ", paste(words.in(s), collapse = ", ")))
  d$k <- lengths(lapply(d$offered, words.in))
  there <- union(everybody, d$participant); gone <- character()
  if (is.null(factors)) { # the same rows as where levels are compared
    lone <- lone.levels(d, c("group", "condition", "stimulus")); gone <- lone$gone
    alike <- alike.for(lone$d, design.of(lone$d)); d <- alike$d; design <- alike$design; factors <- c(design$within, design$between)
    for (note in c(lone$notes, design$notes)) remark(test, "factors", length(unique(d$participant)), note)
  } else design <- list(within = Filter(function(f) any(tapply(level(d, f), d$participant, function(l) length(unique(l))) > 1), factors))
  if (length(design$within) > 0 && has.unequal(d, design$within)) remark(test, "factors", length(unique(d$participant)), over.trials(design$within))
  cell <- do.call(paste, c(list(character(nrow(d))), lapply(design$within, function(f) level(d, f)), sep = "\r"))
  whole.in <- function(of) { n <- tapply(cell[of], d$participant[of], function(own) length(unique(own))); names(n)[n == length(unique(cell[of]))] }
  unknown <- if ("group" %in% factors) groupless(d) # counts in no line of a group
  words.of <- function(f) { words <- paste0(f, "=", level(d, f)); words[f == "group" & d$participant %in% unknown] <- NA; words }
  marks <- lapply(factors, words.of)
  if (length(factors) > 1) { all <- do.call(paste, marks); all[d$participant %in% unknown] <- NA; marks <- c(marks, list(all)) }
  if (length(unknown) > 0) remark(test, "left out", length(unique(d$participant)), paste0(paste(names(unknown), collapse = ", "), ": left out of lines of a group"))
  if (length(absent <- setdiff(there, c(d$participant, gone))) > 0) remark(test, "left out", length(unique(d$participant)), values.lacking(absent))
  if (length(lacking <- setdiff(d$participant, whole.in(TRUE))) > 0) remark(test, "left out", length(unique(d$participant)), paste0(values.lacking(lacking), ": left out of lines over what they lack"))
  groups <- c("all", unlist(lapply(marks, function(m) sort(unique(m)))))
  if (!("task" %in% names(d)) && length(unique(d$level_db)) > 1) remark(test, "factors", length(unique(d$participant)), paste0("levels (", length(unique(d$level_db)), ", column level_db of trials.csv): averaged over"))
  here <- function(group) if (group == "all") rep(TRUE, nrow(d)) else Reduce(`|`, lapply(marks, function(m) m %in% group))
  lines <- do.call(rbind, lapply(groups, function(group) { # of two, one has the other's share; none where chances differ
    own <- d[here(group), ]; one <- words.in(own$offered); if (length(one) == 2) one <- one[1]
    data.frame(group, word = Filter(function(word) length(unique(own$k[is.offered(word, own)])) == 1, one), stringsAsFactors = FALSE)
  }))
  lines <- lines[order(match(lines$word, words), match(lines$group, groups)), ]
  tests <- Map(function(group, word) {
    of <- here(group) & is.offered(word, d); k <- d$k[of][1]
    of <- of & d$participant %in% whole.in(of)
    hits <- tapply(d$choice[of] == word, d$participant[of], sum); n <- tapply(of[of], d$participant[of], length)
    lead <- (k * hits - n) / n # leads of the same size tie to the bit
    away <- lead[lead != 0]
    t <- if (length(n) < 2 || length(away) == 0) NULL else if (k == 2 && length(unique(abs(away))) == 1) binom.test(sum(away > 0), length(away)) else rank.test(lead)
    list(share = mean(hits / n), n = length(n), t = t, equal = sum(lead == 0))
  }, lines$group, lines$word)
  ps <- sapply(tests, function(one) if (is.null(one$t)) NA else one$t$p.value)
  corrected <- p.adjust(ps, "holm")
  family <- paste("Holm,", counted(sum(!is.na(ps)), "test"))
  for (i in seq_along(tests)) {
    one <- tests[[i]]; effect <- if (length(words) == 2) lines$group[i] else paste0(lines$word[i], ", ", lines$group[i])
    if (is.na(ps[i])) result(test, effect, "V", NA, NA, one$n, note = "fewer than two participants with all of it, or shares of chance alone")
    else result(test, effect, if (is.null(one$t$parameter)) "V" else "people above chance, exact binomial", one$t$statistic, ps[i], one$n, p_corrected = corrected[i],
                correction = family, size = paste("share of", lines$word[i]), effect_size = one$share, note = if (is.null(one$t$parameter)) ranks.note(one$t, one$equal, "people at chance") else paste("people not at chance:", one$t$parameter))
  }
}) }
words.in <- function(sets) sort(setdiff(unlist(strsplit(unique(sets), "|", fixed = TRUE)), ""), method = "radix")
is.offered <- function(word, d) { sets <- unique(d$offered); d$offered %in% sets[vapply(sets, function(s) word %in% words.in(s), NA)] }
# What each row had to choose from, as "A|B": its parts, else the answers of its session, or of its stimulus where each has as many and none has all; "" is
# not known.
offered.of <- function(d) {
  one <- function(words) paste(words.in(words), collapse = "|")
  all <- rep(one(c(d$choice, parts.offered(d))), nrow(d))
  if (any(parts.offered(d) != "")) {
    each <- unique(d$parts); own <- vapply(each, one, "")[match(d$parts, each)]; own[own == ""] <- all[own == ""]
    asked <- unique(data.frame(choice = d$choice, own))
    return(unname(if (all(mapply(function(choice, own) choice %in% c("", words.in(own)), asked$choice, asked$own))) own else all)) # parts may be no alternatives
  }
  is.told <- !is.null(d$task) && !is.null(d$session); key <- if (is.told) d$session else d$stimulus
  if (is.null(key)) return(all)
  sets <- vapply(split(d$choice, key), one, ""); n <- lengths(strsplit(sets, "|", fixed = TRUE)); k <- length(words.in(d$choice))
  if (is.told || (k > 2 && n[1] > 1 && n[1] < k && all(n == n[1]))) return(unname(sets)[match(key, names(sets))])
  if (k > 2 && all(n < k)) rep("", nrow(d)) else all
}
parts.offered <- function(d) if ("parts" %in% names(d)) unlist(strsplit(d$parts, "|", fixed = TRUE))

# Names of the factors in a column: words (pair=wood), the letters of the thesis' methods, two parts that are crossed (PHONE-3x3, index_60Hz), or the column.
factor.names <- function(column, d) {
  if (!(column %in% names(d))) return(character())
  cells <- unique(d[[column]]); words <- unlist(strsplit(cells, " ", fixed = TRUE)); parts <- parts.of(cells)
  if (length(words) > 0 && all(grepl("=", words, fixed = TRUE))) return(unique(sub("=.*", "", words)))
  if (length(cells) > 1 && all(grepl("^A[VF]-F[VF]-DR[VF]$", cells))) return(c("A", "F", "DR"))
  isWords <- all(lengths(strsplit(cells, " ", fixed = TRUE)) == 2)
  if (all(lengths(parts) == 2) && (column == "condition" || isWords)) {
    first <- unique(sapply(parts, `[`, 1)); second <- unique(sapply(parts, `[`, 2))
    if (length(second) > 1 && (length(first) > 1 || !isWords) && length(first) * length(second) == length(cells)) return(paste0(column, c(".1", ".2")))
  }
  column
}
# Of other programs' tables: columns of which people have several runs.
runs.of <- function(d) Filter(function(f) any(tapply(d[[f]], d$participant, function(s) length(unique(s))) > 1), intersect(c("session", "phase"), names(d)))
runs.words <- function(d, f) { runs <- unique(d[[f]]); paste0(f, " (", if (length(runs) > 4) length(runs) else paste(runs, collapse = ", "), "): ") }
# Of estimates, that not everybody may have: the protocol (`repeated`), else all trials, say whether people had several levels of a factor.
repeated <- FALSE; trials <- NULL
is.repeated <- function(f) {
  if (f == "group" || is.null(trials) || anyNA(own <- level(trials, f))) return(FALSE)
  repeated || any(tapply(own, trials$participant, function(l) length(unique(l))) > 1)
}
# The factors that rows vary in: of which everybody has all levels with those of the others (within), or one alone (between). Others are averaged over,
# and so are more than 12 stimuli without a factor's name beside other factors.
design.of <- function(d, columns = c("group", "condition", "stimulus")) {
  out <- list(within = character(), between = character(), over = character(), notes = character())
  seen <- list()
  people <- length(unique(d$participant))
  if (!("task" %in% names(d))) for (f in runs.of(d)) { out$over <- c(out$over, f); out$notes <- c(out$notes, paste0(runs.words(d, f), "averaged over, level by level")) }
  for (f in unlist(lapply(columns, factor.names, d))) {
    own <- level(d, f); levels <- unique(own)
    if (f == "group") { own[d$participant %in% groupless(d)] <- ""; levels <- setdiff(own, "") }
    if (length(levels) < 2) next
    if (any(vapply(seen, function(other) nrow(unique(data.frame(other, own))) == length(levels) && length(unique(other)) == length(levels), NA))) next
    if (anyNA(own)) { out$over <- c(out$over, f); out$notes <- c(out$notes, paste(f, "is not of every trial: averaged over, level by level")); next }
    if (f == "stimulus" && length(levels) > 12 && length(seen) > 0) { out$over <- c(out$over, f); out$notes <- c(out$notes, paste0("stimulus (", length(levels), "): averaged over, level by level")); next }
    if (all(tapply(own, d$participant, function(l) length(unique(l))) == 1) && !is.repeated(f)) {
      sizes <- tapply(d$participant, factor(own, levels), function(who) length(unique(who)))
      if (sum(sizes > 1) == 1) { out$notes <- c(out$notes, paste0(f, ": ", paste(names(sizes)[sizes == 1], collapse = ", "), " of one participant alone: not tested")); next }
      out$between <- c(out$between, f)
    } else {
      counts <- do.call(table, unname(c(list(d$participant), lapply(c(out$within, f), function(one) level(d, one)))))
      whole <- sum(apply(counts > 0, 1, all))
      if (whole < max(2, people / 2)) { out$over <- c(out$over, f); out$notes <- c(out$notes, paste0(f, ": of ", people, " participants ", whole, if (whole == 1) " has" else " have", " all its levels", if (length(out$within) > 0) paste(" with those of", paste(out$within, collapse = ", ")), ": averaged over, level by level")); next }
      out$within <- c(out$within, f)
    }
    seen[[f]] <- own
  }
  out
}
# Levels that one person alone has are left out by name: their rows would take the factor from all the others.
lone.levels <- function(d, columns) {
  notes <- character(); before <- d$participant
  for (f in unlist(lapply(columns, factor.names, d))) {
    own <- level(d, f); own[own %in% ""] <- NA
    sizes <- tapply(d$participant, own, function(who) length(unique(who))); lone <- names(sizes)[sizes == 1]
    if (length(sizes) > most.levels || length(sizes) - length(lone) < 2) next # items, or nothing else to compare
    notes <- c(notes, vapply(lone, function(l) paste0(f, ": ", l, " is of ", d$participant[own %in% l][1], " alone: left out"), ""))
    d <- d[!(own %in% lone), ]
  }
  list(d = d, notes = unname(notes), gone = setdiff(before, d$participant))
}
# Means are compared that are of the same levels: who lacks some of what is averaged over is left out. Where fewer than half of the people have them all, levels count that a participant has
# with all those of the factors within people, and nothing is compared between people; who has no such level is left out. Where nobody has two, or of more than 12 (items) or of levels of one
# participant each few people have some, those count that there are.
alike.for <- function(d, design) {
  key <- function(factors) do.call(paste, c(list(character(nrow(d))), lapply(factors, function(f) level(d, f)), sep = "\r"))
  block <- key(design$over); cell <- key(c(design$over, design$within)); own <- paste(d$participant, block)
  number <- function(by) tapply(cell, by, function(cells) length(unique(cells)))
  whole <- number(d$participant) == length(unique(cell))
  full <- number(block); cells <- length(unique(key(design$within))); fewer <- names(full)[full < cells]
  if (length(fewer) > 0 && any(full == cells) && sum(whole) >= max(2, length(whole) / 2)) { # what only some levels of a factor had is no difference between them
    design$notes <- c(design$notes, paste0(paste(design$over, collapse = ", "), ": ", if (length(fewer) > most.levels) counted(length(fewer), "level") else paste(gsub("\r", " ", substring(fewer, 2), fixed = TRUE), collapse = ", "),
                                           ": left out, not with all of ", paste(design$within, collapse = ", ")))
    return(alike.for(d[!(block %in% fewer), ], design))
  }
  if (length(design$over) == 0 || all(whole)) return(list(d = d, design = design))
  are.items <- length(unique(block)) > most.levels || all(tapply(d$participant, block, function(who) length(unique(who))) == 1)
  if (!are.items && sum(whole) >= max(2, length(whole) / 2)) return(list(d = d[d$participant %in% names(whole)[whole], ], design = design))
  if (any(full == cells)) full[] <- cells # a level that nobody has with all of them counts for nobody
  kept <- number(own)[own] == full[block]; people <- unique(d$participant[kept])
  over <- paste(design$over, collapse = ", "); applies <- length(people) >= if (are.items) length(whole) / 2 else 2
  design$notes <- sub("level by level", if (applies) "those that each has" else "unequal levels of people", design$notes)
  if (applies) {
    gone <- unique(data.frame(who = d$participant, block)[!kept & d$participant %in% people, ]); by <- split(gone$who, gone$block)
    design$notes <- c(design$notes, if (length(by) > most.levels) paste0(over, ": ", nrow(gone), " levels of ", length(unique(gone$who)), " participants left out, who lack them elsewhere")
      else if (length(by) > 0) paste0(over, ": ", gsub("\r", " ", substring(names(by), 2), fixed = TRUE), " left out of ", vapply(by, paste, "", collapse = ", "), ", who lack", ifelse(lengths(by) == 1, "s", ""), " it elsewhere"))
    d <- d[kept, ]
  }
  if (!are.items && length(design$between) > 0) {
    design$notes <- c(design$notes, paste0(paste(design$between, collapse = ", "), ": not tested, as people's means are of unequal levels of ", paste(design$over, collapse = ", ")))
    design$between <- character()
  }
  list(d = d, design = design)
}
# People who lack a level may leave a group one person, who would count as much as all of another: such a group is left out, or the factor is not tested.
lone.groups <- function(d, design) {
  cell <- do.call(paste, c(list(character(nrow(d))), lapply(design$within, function(f) level(d, f)), sep = "\r")); n <- tapply(cell, d$participant, function(own) length(unique(own)))
  notes <- character(); before <- d$participant
  for (f in design$between) {
    own <- level(d, f); if (f == "group") own[d$participant %in% groupless(d)] <- NA
    sizes <- tapply(d$participant, own, function(who) sum(n[unique(who)] == length(unique(cell)))); lone <- names(sizes)[sizes == 1]; words <- paste0(f, ": ", paste(names(sizes), "n =", sizes, collapse = ", "), " with all levels: ")
    if (sum(sizes > 1) < 2) { notes <- c(notes, paste0(words, "not tested, and no factor of other tests")); design$between <- setdiff(design$between, f) }
    else if (length(lone) > 0) { notes <- c(notes, paste0(words, paste(lone, collapse = ", "), " left out")); d <- d[!(own %in% lone), ] }
  }
  design$notes <- c(design$notes, notes)
  list(d = d, design = design, gone = setdiff(before, d$participant))
}
# The model that a measure and its factors call for. Scores: analysis of variance, pairs by t. Ranks: Friedman's or Kruskal and Wallis' test, pairs by
# ranks. Magnitudes: ranks of one factor; of several the analysis of variance of their logarithms. No ordinal mixed model of trials: with an intercept for
# each person alone, 12 of 60 studies without an effect have one at 0.05 (Friedman's test: 4), and with one for each person's level it takes half a minute.
most.levels <- 12 # of which every two are compared
as.published <- FALSE # a study -thesis: pairs as 4.2.2 and 5.2.2 have them, by t or Mann and Whitney's ranks, with Bonferroni's correction
spoken <- c(percent_correct = "percent correct", distance = "distance from the target", variable = "variable error", jnd = "JND")
everybody <- character() # who has trials
compare <- function(what, d, measure, kind = "scores", columns = c("group", "condition", "stimulus"), over = character()) {
  column <- sub("=.*", "", measure); all <- union(everybody, d$participant)
  d <- d[!no.value(d, column, measure), ]
  if (length(unique(d$participant)) < 2) return(invisible())
  below <- if (kind == "magnitudes") sum(as.numeric(d[[measure]]) < 0) else 0
  if (below > 0) { kind <- "scores"; what <- sub("magnitudes", "values", what) }
  zeros <- if (kind == "magnitudes") d[as.numeric(d[[measure]]) == 0, ]
  if (kind == "magnitudes") { d <- d[as.numeric(d[[measure]]) > 0, ]; d[[measure]] <- log10(as.numeric(d[[measure]])); what <- paste("log10 of", what) }
  lone <- lone.levels(d, columns); d <- lone$d
  design <- design.of(d, columns); design$notes <- c(lone$notes, design$notes)
  for (f in over) if ((k <- length(unique(level(d, f)))) > 1) { design$over <- c(design$over, f); design$notes <- c(design$notes, paste0(f, " (", k, "): averaged over, level by level")) }
  if (below > 0) design$notes <- c(design$notes, paste0("values below 0: ", below, ", so all compared as values"))
  if (kind == "magnitudes" && length(unique(d$level_db)) > 1) { design$over <- c(design$over, "level_db"); design$notes <- c(design$notes, paste0("levels (", length(unique(d$level_db)), ", column level_db of trials.csv): averaged over, level by level")) }
  if (NROW(zeros) > 0) design$notes <- c(design$notes, paste0(counted(nrow(zeros), "magnitude"), " of 0 left out: ",
    paste(unique(do.call(paste, zeros[intersect(c("participant", "condition", "stimulus", if (length(unique(d$level_db)) > 1) "level_db"), names(zeros))])), collapse = ", ")))
  alike <- alike.for(d, design); groups <- lone.groups(alike$d, alike$design); d <- groups$d; design <- groups$design; factors <- c(design$within, design$between)
  for (note in design$notes) remark(what, "factors", length(unique(d$participant)), if (length(factors) > 0) note else sub("averaged over.*", "not tested", note))
  if (length(factors) == 0) return(invisible())
  if (length(design$over) > 0) { # a participant's mean of each level first: not the level that has most rows
    y <- if (measure %in% names(d)) as.numeric(d[[measure]]) else as.numeric(d[[column]] == sub("^[^=]*=", "", measure))
    own <- do.call(paste, c(list(d$participant), lapply(c(factors, design$over), function(f) level(d, f)), sep = "\r"))
    d[[measure]] <- ave(y, own); d <- d[!duplicated(own), ]
  }
  attr(d, "absent") <- setdiff(all, c(d$participant, lone$gone, groups$gone))
  if (kind == "magnitudes" && length(factors) > 1) kind <- "scores"
  few <- function(some) Filter(function(f) length(unique(level(d, f))) <= most.levels, some)
  name <- paste(what, "by", paste(factors, collapse = ", "))
  if (kind == "scores") anova.test(paste("analysis of variance of", name), d, measure, design$within, between = design$between)
  else { # of two levels a pair is the whole test
    more <- Filter(function(f) length(setdiff(unique(level(d, f)), if (f == "group") c("", NA))) > 2, factors)
    if (length(factors) > 1) result(paste("interactions of", what), paste(factors, collapse = ":"), "", NA, NA, length(unique(d$participant)), note = "no test by ranks")
    if (length(more) > 0)
      friedman(paste(paste(c("Friedman's", "Kruskal and Wallis'")[c(any(design$within %in% more), any(design$between %in% more))], collapse = " and "), "test of", what, "by", paste(more, collapse = ", ")),
               d, measure, design$within, between = design$between, tested = more)
  }
  if (length(few(factors)) > 0)
    pairs.test(paste("pairs by", if (kind == "scores") "t" else "ranks", "of", name), d, measure, few(design$within), by = if (kind == "scores") "t" else "ranks",
               correction = if (as.published) "bonferroni" else "holm", between = few(design$between), paired = !as.published)
  if (length(few(factors)) < length(factors)) result(paste("pairs of", name), paste(setdiff(factors, few(factors)), collapse = ", "), "", NA, NA, length(unique(d$participant)), note = paste("more than", most.levels, "levels"))
}
# Several scales, or shares of several alternatives (`all`), ask one question each: Holm's correction over the tests of an effect that could be made. A
# pair that is all of a factor, as of two levels by ranks, is its test. What is secondary has no part in it. Other pairs are of alternatives one family, all of a factor; of scales each its own.
across <- function(tests, what, all, pairs = TRUE) {
  at <- which(results$test %in% tests & !is.secondary(results$test) & results$statistic %in% c("F", "chi-squared", "V", "W") & !is.na(results$p)); lines <- results[at, ]
  name <- sub(" by [^ ]+(, [^ ]+)*$", "", sub("^(analysis of variance|(Friedman's|Kruskal and Wallis'|Friedman's and Kruskal and Wallis') test|pairs by ranks) of ", "", lines$test))
  p <- ifelse(lines$correction == "Greenhouse-Geisser", lines$p_corrected, lines$p)
  ranks <- lines$statistic %in% c("V", "W"); factor <- sub(": .*", "", lines$effect); pair <- ranks & paste(name, factor) %in% paste(name, factor)[!ranks]
  effect <- ifelse(pair, paste("pairs of", factor), ifelse(ranks, factor, lines$effect))
  for (one in unique(effect[pairs | !pair])) {
    i <- which(effect == one); results$p_across[at[i]] <<- p.adjust(p[i], "holm")
    results$across[at[i]] <<- paste0("Holm, ", counted(length(i), "test"), " over ", what, if (length(no <- setdiff(all, name[i])) > 0) paste0("; without ", paste(no, collapse = ", ")))
  }
}
# Objects that were rated side by side are levels of a factor; one that was also felt openly, the hidden reference, is looked at.
side.by.side <- function(own, objects, words) {
  long <- do.call(rbind, lapply(objects, function(o) cbind(own[intersect(names(own), c("participant", "group", "condition", "stimulus"))], object = o, score = own[[o]])))
  compare(paste0("scores of objects", words), long, "score", columns = c("group", "condition", "stimulus", "object"))
  first <- unique(sub("[|].*", "", own$parts))
  if (length(first) != 1 || any(lengths(strsplit(own$parts, "|", fixed = TRUE)) == length(objects))) return(invisible())
  below <- tapply(as.numeric(own[[first]]) < 90, own$participant, mean)
  who <- names(below)[below > 0.15]
  if (length(who) > 0) remark(paste0("hidden reference", words), "hidden reference", length(below), paste0(first,
    " unnamed was rated below 90 in more than 15 % of trials (ITU-R BS.1534) by ", paste(who, collapse = ", "), ": not excluded"))
}
# Stimuli that were compared in pairs: means over people as a matrix, and a map by classical scaling. Scores whose scale begins with "dis" or "diff"
# are distances; of others what they lack of the scale's end is.
similarity <- data.frame(); places <- data.frame()
in.pairs <- function(own, scale, words, end) for (one in split(own, if ("condition" %in% names(own)) factor(own$condition, unique(own$condition)) else rep("", nrow(own)))) {
  two <- do.call(rbind, strsplit(one$stimulus, " & ", fixed = TRUE)); all <- in.order(c(two)); condition <- c(one$condition[1], "")[1]
  means <- aggregate(y ~ id + a + b, data.frame(y = as.numeric(one[[scale]]), id = one$participant, a = two[, 1], b = two[, 2]), mean)
  means <- aggregate(y ~ a + b, means, mean)
  m <- matrix(NA, length(all), length(all), dimnames = list(all, all))
  m[cbind(means$a, means$b)] <- means$y; m[cbind(means$b, means$a)] <- means$y
  similarity <<- rbind(similarity, data.frame(scale, session = sub("^ in ", "", words), condition, stimulus = all, m, check.names = FALSE, row.names = NULL))
  attempt(paste0("map of ", scale, words), condition, {
    if (length(all) < 3) stop("expected three stimuli or more")
    is.distance <- grepl("^(dis|diff)", scale)
    d <- if (is.distance) m else end - m
    diag(d) <- 0
    map <- cmdscale(as.dist(d), k = 2, eig = TRUE)
    at <- map$points[, seq_len(min(2, sum(map$eig > 1e-9 * max(abs(map$eig))))), drop = FALSE] # rounding makes no dimension
    if (ncol(at) < 1) stop("no map: no eigenvalue is positive")
    stress <- sqrt(sum((dist(at) - as.dist(d))^2) / sum(dist(at)^2)) # Kruskal's
    places <<- rbind(places, data.frame(scale, session = sub("^ in ", "", words), condition, stimulus = all, x = at[, 1], y = if (ncol(at) < 2) NA else at[, 2], stress, distance = if (is.distance) "mean" else paste(end, "- mean")))
  })
}
# How far a participant's answers to the same target scatter around their own mean: what the size of a perceived grid rests on.
scatter.of <- function(own) {
  own$target <- paste(own$target_row, own$target_column); keys <- intersect(c("participant", "group", "condition", "target"), names(own))
  of <- interaction(own[keys], drop = TRUE)
  both <- tapply(as.numeric(own$x), of, var) + tapply(as.numeric(own$y), of, var)
  na.omit(cbind(own[match(levels(of), of), keys, drop = FALSE], variable = as.vector(sqrt(both))))
}
# As Table 4.1 of the thesis has it, of its own study alone: every trial is a unit, and people are a block. Answers of one person are no independent
# units, so its p are too small.
single.trials <- function(test, own, measure) { attempt(test, "all", {
  rows <- rows.of(own, measure, c("target_column", "target_row"))
  a <- anova(lm(y ~ id + w1 * w2, rows)); left <- nrow(a)
  for (i in 2:(left - 1)) result(test, c("", "target_column", "target_row", "target_column:target_row")[i], "F", a$F[i], a$`Pr(>F)`[i], nrow(rows), a$Df[i], a$Df[left])
}) }
# All tests of a report's folder. `scales`: the columns of ratings; `points`: those of them whose scores are ranks; `half`: what the page calls the level of
# a half; `within`: by the protocol everybody has each condition.
study <- function(study, scales = character(), points = character(), half = "threshold", within = FALSE) {
  d <- table.of("trials.csv")
  as.published <<- grepl("protocol [^ ]*-thesis", study)
  if (!("participant" %in% names(d))) return(finish(study))
  is.told <- "task" %in% names(d); everybody <<- unique(d$participant); trials <<- d; repeated <<- within
  if (is.told) for (column in setdiff(c("session", "correct", "level_db"), names(d))) d[[column]] <- rep("", nrow(d))
  if (!is.told) points <- union(points, Filter(function(scale) all(d[[scale]] %in% c("", "NA") | suppressWarnings(as.numeric(d[[scale]])) %in% 1:7), scales)) # of other programs
  # a trial that ran out of time has no other answer
  at <- if ("session" %in% names(d)) d$session else rep("", nrow(d))
  for (s in unique(at[which(d$ran_out == "1")]))
    compare(paste0("share of trials that ran out of time", if (nzchar(s)) paste(" in", s)), d[at == s, ], "ran_out", "ranks", c("group", "condition"))
  # rows of a task, session by session where there are several; of tables without tasks those with the column
  each <- function(task, column, run) {
    if (!(column %in% names(d))) return(invisible())
    own <- if (is.told) d[d$task == task, ] else d
    own <- own[!no.value(own, column), ]
    sessions <- if (is.told) unique(own$session) else ""
    for (s in sessions) run(if (is.told) own[own$session == s, ] else own, if (length(sessions) > 1) paste(" in", s) else "")
  }
  parts.in <- function(own, run) { # a table's conditions are "low in second" where sessions are parted
    word <- rep("", nrow(own))
    for (s in unique(d$session)) word[endsWith(own$condition, paste(" in", s))] <- paste(" in", s)
    own$condition <- substring(own$condition, 1, nchar(own$condition) - nchar(word))
    for (w in unique(word)) run(own[word == w, ], w)
  }
  from <- function(file, measures, columns = c("group", "condition"), words = "", over = character()) if (file.exists(file)) parts.in(table.of(file), function(own, session) {
    name <- function(m) if (m %in% names(spoken)) spoken[[m]] else m
    what <- paste0(paste(vapply(measures, name, ""), collapse = ", "), words)
    if (!is.told) for (f in runs.of(d)) remark(what, "factors", length(unique(own$participant)), paste0(runs.words(d, f), "all trials together"))
    for (m in measures) compare(paste0(name(m), words, session), own, m, columns = columns, over = over)
  })
  spoken <- c(spoken, threshold = half); if (half == "threshold") spoken[["jnd"]] <- "half interquartile range" # of forced choices a slope
  from("identification.csv", "percent_correct")
  if (file.exists("identification.csv") && has.unequal(d, all <- intersect(c("condition", "stimulus"), names(d)))) remark("percent correct", "factors", length(everybody), over.trials(all))
  from("identification-tolerance-1.csv", "percent_correct", words = " with one step of tolerance")
  if (all(c("target_column", "target_row") %in% names(d))) each("locate", "x", function(own, words) {
    compare(paste0("variable error", words), scatter.of(own), "variable", columns = c("group", "condition"), over = "target")
    targets <- c("target_y", "target_x"); if (!all(targets %in% names(own))) targets <- c("target_row", "target_column") # which number those of other programs
    for (t in targets) own[[t]] <- as.character(signif(as.numeric(own[[t]]), 4))
    for (one in split(own, if ("condition" %in% names(own)) factor(own$condition, unique(own$condition)) else rep("", nrow(own)))) {
      place <- if (length(unique(own$condition)) > 1) paste(words, "of", one$condition[1]) else words
      for (m in c("x", "y")) {
        compare(paste0(m, place), one, m, columns = c("group", targets))
        if (grepl("protocol phantom-places-thesis", study, fixed = TRUE)) single.trials(paste0(m, place, ", single trials as in Table 4.1"), one, m)
      }
    }
  })
  from("places.csv", c("distance", if (!all(c("target_column", "target_row") %in% names(d))) "variable"), over = "target") # the same as above
  has.functions <- function(words) file.exists("psychometric-stimuli.csv") && any(endsWith(table.of("psychometric-stimuli.csv")$condition, words))
  each("choose", if ("choice" %in% names(d)) "choice" else "response", function(own, words) {
    if (is.told) own <- own[own$correct == "" | own$level_db == "", ] # levels that follow the answers
    else if (!("choice" %in% names(d))) return()
    if (length(unique(own$participant)) < 2) return()
    if (!has.functions(words)) choices(paste0("shares of the alternatives", words, " against chance"), own)
    stimuli <- if ("stimulus" %in% names(own)) "stimulus"; isFunction <- file.exists("psychometric-stimuli.csv") # which tells more of levels
    sets <- offered.of(own)
    for (set in setdiff(in.order(sets), "")) { # trials of other alternatives are not comparable
      names <- words.in(set); before <- unique(results$test); of <- paste0(words, if (!all(sets == set)) paste(" where offered were", paste(names, collapse = ", ")))
      for (a in if (length(names) == 2) names[1] else names)
        compare(paste0("choice=", a, of), own[sets == set, ], paste0("choice=", a), "ranks", c("group", "condition", if (!isFunction) stimuli), if (isFunction) stimuli)
      if (length(names) > 2) across(setdiff(unique(results$test), before), "alternatives", paste0("choice=", names, of))
    }
  })
  before <- unique(results$test)
  aside <- character() # sessions whose scales are objects
  if (is.told && "parts" %in% names(d)) for (s in unique(d$session[d$task == "rate"])) {
    own <- d[d$task == "rate" & d$session == s, ]
    objects <- intersect(scales, unlist(strsplit(own$parts, "|", fixed = TRUE)))
    objects <- Filter(function(o) all(own[[o]] != ""), objects)
    if (length(objects) > 1) { aside <- c(aside, s); side.by.side(own, objects, if (length(unique(d$session[d$task == "rate"])) > 1) paste(" in", s) else "") }
  }
  asked <- character()
  for (scale in scales) { none <- TRUE; each("rate", scale, function(own, words) {
    none <<- FALSE
    if (is.told && own$session[1] %in% aside) return()
    asked <<- c(asked, paste0(scale, words))
    if ("stimulus" %in% names(own) && all(grepl(" & ", own$stimulus, fixed = TRUE))) {
      in.pairs(own, scale, words, if (is.told && !(scale %in% points)) 100 else max(as.numeric(own[[scale]]))) # of points, and of other programs, the largest that was given
      compare(paste0(scale, words), own, scale, columns = c("group", "condition"))
    } else compare(paste0(scale, words), own, scale, if (scale %in% points) "ranks" else "scores")
  }); if (none) asked <- c(asked, scale) }
  if (length(scales) > 1) across(setdiff(unique(results$test), before), "scales", asked, pairs = FALSE)
  if (file.exists("thresholds.csv")) parts.in(table.of("thresholds.csv"), function(own, session) {
    for (m in unique(own$method)) compare(paste0("threshold by ", m, session), own[own$method == m, ], "threshold", columns = c("group", "condition"))
  }) else from("psychometric.csv", c("threshold", "jnd"))
  # Thresholds among other levels in each condition differ by what was played: only slopes are compared then.
  chosen <- if (is.told) d[d$task == "choose", ] else d
  played <- if (all(c("stimulus", "condition") %in% names(d))) tapply(chosen$stimulus, chosen$condition, function(s) paste(in.order(s), collapse = " "))
  is.alike <- !file.exists("psychometric-stimuli.csv") || length(unique(played[names(played) %in% table.of("psychometric-stimuli.csv")$condition])) < 2
  if (!is.alike) result(half, "condition", "", NA, NA, length(everybody), note = "other levels in each condition")
  from("psychometric-stimuli.csv", c(if (is.alike) "threshold", "jnd"))
  if (!is.told && !any(file.exists(c("identification.csv", "psychometric.csv")))) each("", "correct", function(own, words) compare("share of right answers", own, "correct"))
  each("adjust", "value", function(own, words) if (is.told) compare(paste0("matched levels", words), own, "value"))
  each("estimate", "value", function(own, words) compare(paste0("magnitudes", words), own, "value", "magnitudes"))
  from("power-law.csv", "exponent")
  for (column in c("condition", "stimulus")) if (any(grepl(paste0(column, ".1"), c(results$test, results$effect), fixed = TRUE)))
    remark(column, "factors", length(everybody), paste0(column, ".1, ", column, ".2: first and second part of ", d[[column]][1], " and so on"))
  finish(study)
}
finish <- function(study) {
  everybody <<- character(); trials <<- NULL
  lme4 <- if (any(is.secondary(results$test)) && requireNamespace("lme4", quietly = TRUE)) paste(", lme4", packageVersion("lme4")) else ""
  writeLines(paste0("# ", study, ", ", R.version.string, lme4), "tests.csv")
  for (table in list(list(similarity, "similarity.csv"), list(places, "mds.csv"))) if (nrow(table[[1]]) > 0) {
    if (all(table[[1]]$session == "")) table[[1]]$session <- NULL
    writeLines(paste0("# ", study, ", ", R.version.string), table[[2]])
    write.table(table[[1]], table[[2]], append = TRUE, sep = ",", row.names = FALSE, na = "", qmethod = "double")
  }
  if (nrow(results) > 0) write.table(results, "tests.csv", append = TRUE, sep = ",", row.names = FALSE, na = "", qmethod = "double")
  if (!("quiet" %in% commandArgs(TRUE))) cat("tests.csv  ", nrow(results), " lines\n", sep = "")
}
