# SPDX-License-Identifier: MIT
# Rscript analysis_test.R ANALYSIS.R: what the script of a report says of designs at the edges, beside what R's own functions say of them.
script <- normalizePath(commandArgs(TRUE)[1])
source(file.path(dirname(sub("^--file=", "", grep("^--file=", commandArgs(FALSE), value = TRUE))), "exact.R"))
own <- tempfile(); dir.create(own)
options(warn = -1)
source(script)
setwd(own)
set.seed(7)
faults <- 0
fault <- function(...) { faults <<- faults + 1; cat("FAULT:", ..., "\n") }
same <- function(words, ours, r) {
  known <- length(ours) == 1 && length(r) == 1 && !is.na(ours) && !is.na(r)
  if (!known || abs(ours - r) > max(1e-9 * abs(r), 1e-14)) fault(words, "is", format(ours, digits = 12), "for", format(r, digits = 12))
}
tested <- function() results[!(results$kind %in% "mean"), ]
told <- function(run) { results <<- data.frame(); capture.output(run); tested() }
line <- function(lines, effect) lines[lines$effect == effect & !is.secondary(lines$test), ]
mixed.line <- function(lines, effect) lines[lines$effect == effect & is.secondary(lines$test), ]
rows <- function(d, name = "trials.csv") { writeLines("# of a test", name); write.table(d, name, append = TRUE, sep = ",", row.names = FALSE, na = "", quote = TRUE) }
person <- function(n) sprintf("%02d", seq_len(n)) # text that would be numbers

# Repeated measures: F by strata of aov, sphericity by R's multivariate models.
for (n in c(2, 3, 4, 12, 49, 50)) for (levels in list(2, 3, 6, c(2, 3), c(2, 2, 2), c(3, 4))) {
  names <- letters[seq_along(levels)]
  d <- expand.grid(c(lapply(levels, function(k) paste0("l", seq_len(k))), list(person(n)), list(1:2)), stringsAsFactors = FALSE)
  names(d) <- c(names, "participant", "trial")
  d$y <- round(rnorm(nrow(d)) + rnorm(n)[as.integer(d$participant)], 3)
  if (n == 12) { d <- rbind(d, d[1:7, ]); d$y[nrow(d)] <- 9 } # more repeats of some cells
  lost <- if (n == 12) "03" else ""
  if (n == 12) d <- d[!(d$participant == lost & d$a == "l1"), ]
  rows(d[sample(nrow(d)), ])
  ours <- told(anova.test("t", "trials.csv", "y", names))
  m <- aggregate(d["y"], d[c(names, "participant")], mean)
  m <- m[m$participant != lost, ]
  for (f in c(names, "participant")) m[[f]] <- factor(m[[f]])
  strata <- summary(aov(as.formula(paste("y ~", paste(names, collapse = "*"), "+ Error(participant/(", paste(names, collapse = "*"), "))")), m))
  for (stratum in strata) for (effect in trimws(rownames(stratum[[1]]))) if (effect != "Residuals") {
    row <- stratum[[1]][trimws(rownames(stratum[[1]])) == effect, ]; own <- line(ours, effect); words <- paste("F", effect, "n", n, "of", paste(levels, collapse = "x"))
    same(words, own$value, row[["F value"]]); same(paste(words, "p"), own$p, row[["Pr(>F)"]]); same(paste(words, "df"), own$df1, row[["Df"]])
    if (own$n != length(unique(m$participant))) fault(words, "has n", own$n)
  }
  if (length(levels) == 1 && levels == 2 && n > 3) {
    wide <- with(m, tapply(y, list(participant, a), mean))
    same(paste("normality of differences, n", n), line(ours, "normality of the differences")$p, shapiro.test(wide[, 1] - wide[, 2])$p.value)
    if (n == 12) { # pairs by ranks alone tell who is lacking; beside another test they do not say it again
      if (line(told(pairs.test("pairs by ranks of y by a", "trials.csv", "y", "a", by = "ranks")), "left out")$n != 11) fault("who lacks a level of pairs by ranks is not told")
      both <- told({ anova.test("analysis of variance of y by a", "trials.csv", "y", "a"); pairs.test("pairs by t of y by a", "trials.csv", "y", "a") })
      if (sum(both$effect == "left out") != 1) fault("who lacks a level is told twice")
    }
  }
  if (length(levels) == 1 && levels > 2 && n > levels) {
    wide <- with(m, tapply(y, list(participant, a), mean)); fit <- lm(wide ~ 1)
    r <- anova(fit, update(fit, ~ 0), X = ~ 1, M = ~ a, idata = data.frame(a = factor(seq_len(levels))), test = "Spherical")
    same(paste("G-G p, n", n), line(ours, "a")$p_corrected, r[["G-G Pr"]][2])
    same(paste("Mauchly p, n", n), line(ours, "a sphericity")$p, mauchly.test(fit, X = ~ 1)$p.value)
    left <- aov(y ~ a + participant, m)$residuals
    same(paste("normality, n", n), line(ours, "residuals normality")$p, shapiro.test(left)$p.value)
    if (line(ours, "residuals normality")$note != paste("residuals:", length(left))) fault("the number of residuals is not told")
  }
}

# Ranks and pairs of 2 to 51 people, where R goes from exact to normal p at 50; with ties and zeros, and without.
for (n in c(2, 3, 6, 49, 50, 51)) for (digits in c(0, 6)) for (k in c(2, 3)) {
  d <- expand.grid(condition = paste0("pair=c", seq_len(k)), participant = person(n), stringsAsFactors = FALSE)
  d$y <- round(rnorm(nrow(d), as.integer(factor(d$condition)) / 3), digits)
  rows(d)
  wide <- with(d, tapply(y, list(participant, condition), mean)); words <- paste("n", n, "digits", digits, "levels", k)
  r <- friedman.test(wide); ours <- told(friedman("t", "trials.csv", "y", "pair")); few <- function(differ) sum(differ) < min(3, n)
  if (is.nan(r$p.value) || few(apply(wide, 1, function(y) any(y != y[1])))) { if (ours$note == "") fault("Friedman of ties", words) } else same(paste("Friedman", words), ours$p, r$p.value)
  for (by in c("t", "ranks", "unpaired ranks")) for (correction in c("holm", "bonferroni")) {
    paired <- by != "unpaired ranks"
    ours <- told(pairs.test("t", "trials.csv", "y", "pair", by = sub("unpaired ", "", by), correction = correction, paired = paired))
    two <- combn(k, 2)
    ps <- apply(two, 2, function(i) { a <- wide[, i[1]]; b <- wide[, i[2]]; if (by == "ranks" && few(a != b)) return(NaN) # one who differs of three
      tryCatch(if (by == "t") t.test(a, b, paired = TRUE)$p.value else if (paired) exact.p(a - b) else exact.p(a, b), error = function(e) NaN) })
    corrected <- p.adjust(ps, correction)
    for (i in seq_along(ps)) { own <- line(ours, paste0("pair: c", two[1, i], " - c", two[2, i]))
      if (is.nan(ps[i])) { if (own$note == "") fault("pair of ties", words) } else {
        same(paste(by, words), own$p, ps[i]); same(paste(by, correction, words), own$p_corrected, corrected[i]) } }
  }
}

# Choices between two, of 1, 6, 49 and 50 people who had unequal numbers of trials; training and rows without a choice count for nothing.
for (n in c(1, 6, 49, 50)) {
  d <- expand.grid(trial = 1:6, stimulus = c("pair=wood size=small", "pair=steel size=small"), participant = person(n), stringsAsFactors = FALSE)
  d$phase <- "main"; d$task <- "choose"; d$choice <- ifelse(runif(nrow(d)) < 0.6, "B", "A")
  d <- d[-sample(nrow(d), 3), ]
  junk <- d[1:4, ]; junk$phase <- "training"; empty <- d[5:6, ]; empty$choice <- ""
  rows(rbind(junk, empty, d))
  ours <- told(choices("t", "trials.csv"))
  share <- function(d) tapply(d$choice == "A", d$participant, function(x) (2 * sum(x) - length(x)) / length(x))
  if (n == 1) { if (any(ours$kind == "test")) fault("one person is tested") } else {
    same(paste("choices, n", n), line(ours, "all")$p, exact.p(share(d)))
    at <- sum(share(d) == 0); if (grepl("at chance", line(ours, "all")$note) != (at > 0) || at > 0 && !startsWith(line(ours, "all")$note, paste0("people at chance: ", at))) fault("people at chance are not told")
    same(paste("choices of wood, n", n), line(ours, "pair=wood")$p, exact.p(share(d[grepl("wood", d$stimulus), ])))
    same(paste("share, n", n), line(ours, "all")$effect_size, mean((share(d) + 1) / 2))
    same(paste("Holm, n", n), min(ours$p_corrected, na.rm = TRUE), min(p.adjust(ours$p, "holm"), na.rm = TRUE))
    names(d)[names(d) == "choice"] <- "response"; rows(d)
    same(paste("in a column response, n", n), line(told(choices("t", "trials.csv")), "all")$p, line(ours, "all")$p)
  }
}
# Three alternatives: each against a third.
d <- expand.grid(trial = 1:4, condition = c("c1", "c2"), participant = c("NA", "1", "01", "P"), stringsAsFactors = FALSE)
d$choice <- sample(c("A", "B", "C"), nrow(d), TRUE)
rows(d)
ours <- told(choices("t", "trials.csv"))
if (line(ours, "chance")$note != "1 of 3, answers given: A, B, C") fault("chance has no value")
for (word in c("A", "B", "C")) same(paste(word, "of three"), line(ours, paste0(word, ", all"))$p,
  exact.p(as.vector(tapply(d$choice == word, d$participant, function(x) (3 * sum(x) - length(x)) / length(x)))))
# Pairs of three alternatives: chance is of those that were offered, and nothing is said of or compared with what was not; by parts, or by the answers to a stimulus.
d <- expand.grid(trial = 1:8, stimulus = c("AB", "AC", "BC"), condition = c("c1", "c2"), participant = person(6), stringsAsFactors = FALSE)
d$choice <- substring(d$stimulus, i <- sample(1:2, nrow(d), TRUE, c(0.7, 0.3)), i); d$parts <- paste(substring(d$stimulus, 2), substring(d$stimulus, 1, 1), sep = "|")
for (of in c("offered", "answers to a stimulus")) {
  rows(if (of == "offered") d else d[names(d) != "parts"]); ours <- told(choices("t", "trials.csv", "stimulus")); own <- d[d$stimulus == "AC", ]
  same(paste("A of AC,", of), line(ours, "A, stimulus=AC")$p, exact.p(as.vector(tapply(own$choice == "A", own$participant, function(x) 2 * mean(x) - 1))))
  if (!setequal(setdiff(ours$effect, "chance"), c("A, all", "B, all", "C, all", "A, stimulus=AB", "A, stimulus=AC", "B, stimulus=BC"))) fault("lines are of what was not offered, or are lacking:", ours$effect)
  if (!(paste0("1 of 2, ", of, ": A, C") %in% ours$note)) fault("chance is not of what was offered:", of)
  results <- data.frame(); all <- { capture.output(study("of a test")); tested() }
  if (any(grepl("stimulus", all$test)) || sum(all$effect == "condition: c1 - c2") != 3) fault("alternatives are compared where others were offered, or not where they were:", all$test)
  if (!any(grepl("not comparable: other alternatives", told(pairs.test("t", "trials.csv", "choice=A", "stimulus", by = "ranks"))$note))) fault("shares of other alternatives are compared")
}
d <- d[!(d$stimulus == "BC" & d$choice == "C"), names(d) != "parts"]; rows(d) # B alone
if (!any(grepl("which alternatives were offered is not known", told(choices("t", "trials.csv"))$note))) fault("what was offered is guessed")
# Sessions of other alternatives: a call that names the factor session compares nothing.
d <- expand.grid(trial = 1:8, session = c("AB", "BC"), participant = person(6), stringsAsFactors = FALSE); d$task <- "choose"; d$choice <- substring(d$session, i <- sample(1:2, nrow(d), TRUE), i)
for (parts in c(TRUE, FALSE)) { if (parts) d$parts <- "B|C" else d$parts <- NULL; if (parts) d$parts[d$session == "AB"] <- "A|B"; rows(d)
  for (a in c("A", "B")) if (!any(grepl("not comparable: other alternatives", told(pairs.test("t", "trials.csv", paste0("choice=", a), "session", by = "ranks"))$note))) fault("sessions of other alternatives are compared") }
# Unanimous: exact binomials of people, though the other alternative was only there to choose.
d <- expand.grid(trial = 1:4, stimulus = c("s", "t"), participant = person(8), stringsAsFactors = FALSE)
d$choice <- "80"; d$parts <- "80|200"; rows(d)
ours <- told(choices("t", "trials.csv"))
same("8 of 8 choose it", line(ours, "all")$p, binom.test(0, 8)$p.value)
d <- expand.grid(trial = 1:4, condition = c("c1", "c2"), participant = c("NA", "1", "01", "P"), stringsAsFactors = FALSE)
d$choice <- sample(c("A", "B", "C"), nrow(d), TRUE)
rows(d)
ours <- told(pairs.test("t", "trials.csv", "choice=B", "condition"))
wide <- with(d, tapply(choice == "B", list(participant, condition), mean))
if (ours$n != 4) fault("NA, 1 and 01 are three people, found", ours$n)
r <- tryCatch(t.test(wide[, 1], wide[, 2], paired = TRUE)$p.value, error = function(e) NaN)
if (!is.nan(r)) same("one of three", ours$p, r)
# What a spreadsheet would take for a formula stands behind an apostrophe in our tables.
d <- expand.grid(trial = 1:6, condition = c("a", "b"), participant = person(6), stringsAsFactors = FALSE)
d$choice <- sample(c("'+6 dB", "'-6 dB"), nrow(d), TRUE); rows(d)
wide <- with(d, tapply(choice == "'+6 dB", list(participant, condition), mean))
same("+6 dB", told(pairs.test("t", "trials.csv", "choice=+6 dB", "condition"))$p, t.test(wide[, 1], wide[, 2], paired = TRUE)$p.value)
# Factors in names: parts of conditions, letters of the thesis' methods, words of stimuli; a filter by one of them.
d <- expand.grid(condition = c("PHONE-3x3", "PHONE-4x4", "RING-3x3", "RING-4x4"), stimulus = c("AV-FF-DRV", "AF-FF-DRV"), participant = person(5), stringsAsFactors = FALSE)
d$y <- rnorm(nrow(d)); rows(d)
ours <- told(anova.test("t", "trials.csv", "y", c("condition.2", "A"), where = "condition.1=RING"))
ring <- d[startsWith(d$condition, "RING"), ]
for (f in names(ring)[1:3]) ring[[f]] <- factor(ring[[f]])
r <- summary(aov(y ~ condition * stimulus + Error(participant / (condition * stimulus)), ring))
rows(transform(d, condition = sub("-", "_", d$condition)))
same("index_60Hz", line(told(anova.test("t", "trials.csv", "y", design.of(table.of("trials.csv"))$within)), "condition.1")$p, line(told({ rows(d); anova.test("t", "trials.csv", "y", c("condition.1", "condition.2", "A")) }), "condition.1")$p)
same("condition.2", line(ours, "condition.2")$p, r[["Error: participant:condition"]][[1]][1, "Pr(>F)"])
same("A of AV", line(ours, "A")$p, r[["Error: participant:stimulus"]][[1]][1, "Pr(>F)"])
# Nothing to be found is told, and the other lines stand.
d <- expand.grid(condition = c("x", "y", "z"), participant = person(5), stringsAsFactors = FALSE)
d$y <- ifelse(d$condition == "z", rnorm(15), 1)
rows(d)
ours <- told(pairs.test("t", "trials.csv", "y", "condition"))
if (line(ours, "condition: x - y")$note == "" || is.na(line(ours, "condition: x - z")$p)) fault("one tied pair withholds the others")
for (kind in list(anova.test, friedman, pairs.test)) {
  ours <- told(kind("t", "trials.csv", "y", "condition", where = "condition=nobody"))
  if (nrow(ours) != 1 || ours$note == "") fault("nothing that fits")
}
# Groups of unequal size, beside factors within: strata of aov where groups are equal, sums of squares of type III of linear models where not.
for (sizes in list(c(6, 6), c(4, 7), c(5, 3, 6))) {
  n <- sum(sizes); group <- rep(paste0("g", seq_along(sizes)), sizes)
  d <- expand.grid(trial = 1:2, stimulus = c("f=1 l=a", "f=2 l=a", "f=1 l=b", "f=2 l=b", "f=1 l=c", "f=2 l=c"), participant = person(n), stringsAsFactors = FALSE)
  d$group <- group[as.integer(d$participant)]; d$y <- rnorm(nrow(d)) + rnorm(n)[as.integer(d$participant)] + (d$group == "g1") * grepl("f=1", d$stimulus)
  d$f <- sub(" .*", "", d$stimulus); d$l <- sub(".* ", "", d$stimulus); rows(d[c("participant", "stimulus", "group", "y")])
  design <- design.of(table.of("trials.csv"))
  if (!identical(design[1:2], list(within = c("f", "l"), between = "group"))) fault("design", paste(unlist(design), collapse = " "))
  ours <- told(anova.test("t", "trials.csv", "y", c("f", "l"), between = "group")); words <- paste("groups of", paste(sizes, collapse = ", "))
  m <- aggregate(y ~ f + l + group + participant, d, mean)
  if (length(unique(sizes)) == 1) {
    strata <- summary(aov(y ~ group * f * l + Error(participant / (f * l)), m))
    for (stratum in strata) for (effect in trimws(rownames(stratum[[1]]))) if (effect != "Residuals")
      same(paste(words, effect), line(ours, effect)$p, stratum[[1]][trimws(rownames(stratum[[1]])) == effect, "Pr(>F)"])
  }
  score <- tapply(m$y * ifelse(m$f == "f=1", 1, -1), m$participant, sum) # of f: one contrast, so R's own tests of a linear model
  model <- lm(score ~ g, data.frame(score, g = factor(group)), contrasts = list(g = "contr.sum"))
  same(paste(words, "f"), line(ours, "f")$p, coef(summary(model))[1, 4])
  same(paste(words, "group:f"), line(ours, "group:f")$p, anova(model)[["Pr(>F)"]][1])
  same(paste(words, "f by t"), line(told(pairs.test("t", "trials.csv", "y", c("f", "l"), between = "group")), "f: 1 - 2")$p, coef(summary(model))[1, 4])
  all <- tapply(m$y, m$participant, mean)
  same(paste(words, "group"), line(ours, "group")$p, anova(lm(all ~ group))[["Pr(>F)"]][1])
  pooled <- pairwise.t.test(all, group, p.adjust.method = "none")$p.value
  ours <- told(pairs.test("t", "trials.csv", "y", between = "group"))
  same(paste(words, "pair"), line(ours, "group: g1 - g2")$p, pooled[1, 1])
  same(paste(words, "ranks"), line(told(pairs.test("t", "trials.csv", "y", between = "group", by = "ranks")), "group: g1 - g2")$p,
       exact.p(all[group == "g1"], all[group == "g2"]))
}
# Where people do not differ beyond their trials, groups would be tested against cells: that alone is withheld.
if (requireNamespace("lme4", quietly = TRUE)) {
  d <- expand.grid(condition = c("x", "y", "z"), participant = person(8), stringsAsFactors = FALSE); d$y <- rnorm(nrow(d)); d$y <- d$y - ave(d$y, d$participant); d$group <- ifelse(d$participant < "05", "g", "h"); rows(d[-1, ])
  ours <- told(anova.test("t", "trials.csv", "y", "condition", between = "group"))
  if (!grepl("^variance of participant, its error, is estimated as 0 in the model with all effects$", mixed.line(ours, "group")$note) || is.na(mixed.line(ours, "condition")$p)) fault("a model of cells as people is told, or more is withheld")
}
# Magnitudes are averaged as logarithms, over levels in dB with a word.
d <- expand.grid(level_db = c(0, 6), participant = person(8), stringsAsFactors = FALSE); d$group <- ifelse(as.integer(d$participant) %% 2 == 0, "a", "b"); d$value <- round(exp(rnorm(nrow(d), 2)), 2)
rows(d)
ours <- told(compare("magnitudes", table.of("trials.csv"), "value", "magnitudes")); logs <- tapply(log10(d$value), d$participant, mean); in.a <- tapply(d$group == "a", d$participant, all)
same("logarithms by ranks", line(ours, "group: a - b")$p, exact.p(logs[in.a], logs[!in.a]))
d$value[3] <- 0; rows(d)
if (!any(grepl("1 magnitude of 0 left out: 02 0$", told(compare("magnitudes", table.of("trials.csv"), "value", "magnitudes"))$note))) fault("a magnitude of 0 goes without a word")
one <- d[d$level_db == 0, ]; one$value[1] <- 0; zero <- told(compare("magnitudes", one, "value", "magnitudes"))
if (!any(grepl("left out: 01, 02$", zero$note)) || !("note" %in% zero$kind)) fault("a magnitude of 0 is told with a level that does not vary, or as a test")
if (!any(grepl("levels (2, column level_db of trials.csv): averaged over", ours$note, fixed = TRUE))) fault("levels that are averaged over are not told")
# People who lack levels, in a mixed model of all: the likelihood ratios of lmer's own formulas, with factors within and between.
if (requireNamespace("lme4", quietly = TRUE)) {
  d <- expand.grid(trial = 1:2, condition = c("x", "y", "z"), participant = person(14), stringsAsFactors = FALSE)
  d$group <- ifelse(as.integer(d$participant) <= 6, "a", "b"); d$y <- rnorm(nrow(d)) + rnorm(14)[as.integer(d$participant)] + 0.7 * (d$condition == "z")
  d <- d[!(d$participant %in% c("03", "09") & d$condition == "y"), ]; rows(d)
  for (between in list(character(), "group")) {
    ours <- told(anova.test("t", "trials.csv", "y", "condition", between = between)); m <- aggregate(y ~ ., d[names(d) != "trial"], mean)
    chi <- function(all, without) 2 * as.numeric(logLik(lme4::lmer(all, m, REML = FALSE)) - logLik(lme4::lmer(without, m, REML = FALSE)))
    same("mixed model", mixed.line(ours, "condition")$value, if (length(between) == 0) chi(y ~ condition + (1 | participant), y ~ 1 + (1 | participant)) else {
      x <- model.matrix(~ condition * group, m, list(condition = "contr.sum", group = "contr.sum")); at <- attr(x, "assign")
      chi(y ~ 0 + x + (1 | participant), y ~ 0 + x[, at != 1] + (1 | participant)) })
    if (length(between) > 0) same("mixed interaction", mixed.line(ours, "condition:group")$value, chi(y ~ condition * group + (1 | participant), y ~ condition + group + (1 | participant)))
    if (mixed.line(ours, "condition")$n != 14 || line(ours, "left out")$n != 12) fault("who is in which model")
  }
} else cat("lme4 is not here: its models were not tried\n")
# Objects side by side are a factor; a hidden reference that is rated low is told; points are ranks; groups stand in the table of people.
whole <- function(d, scales, points = character(), people = NULL, ...) {
  unlink(c("similarity.csv", "mds.csv", "participants.csv")); rows(d); if (!is.null(people)) rows(people, "participants.csv")
  results <<- similarity <<- places <<- data.frame(); capture.output(study("of a test", scales, points, ...)); tested()
}
# A group that stands in the trials alone is a factor of what is computed of them, too.
d <- data.frame(participant = rep(person(8), each = 3), condition = c("x", "y", "z"), group = rep(c("a", "b"), each = 12), threshold = as.character(rnorm(24)), jnd = "1")
writeLines("# of a test", "psychometric.csv"); write.table(d[c("participant", "condition", "threshold", "jnd")], "psychometric.csv", append = TRUE, sep = ",", row.names = FALSE, quote = TRUE)
ours <- whole(d[c("participant", "condition", "group")], NULL)
same("group of thresholds", line(ours[grepl("^analysis of variance of threshold", ours$test), ], "group")$p,
     anova(lm(y ~ g, data.frame(y = tapply(as.numeric(d$threshold), d$participant, mean), g = rep(c("a", "b"), each = 4))))[["Pr(>F)"]][1])
if (line(told(anova.test("t", "psychometric.csv", "threshold", "condition")), "condition")$correction != "Greenhouse-Geisser") fault("the correction is not named")
rows(d, "psychometric-stimuli.csv"); unlink("psychometric.csv")
if (!any(grepl("of point of subjective equality by", whole(d, NULL, half = "point of subjective equality")$test))) fault("half of two answers is called a threshold")
unlink("psychometric-stimuli.csv")
# Sessions of a kind are studies of their own, in tables of the report by the end of their conditions' names.
d <- expand.grid(condition = c("x", "y", "z"), session = c("early", "late"), participant = person(8), stringsAsFactors = FALSE); d$task <- "choose"; d$phase <- "main"
d$threshold <- rnorm(nrow(d)) + 4 * (d$session == "late"); d$method <- "staircase"; rows(d, "thresholds.csv"); own <- d; own$condition <- paste(d$condition, "in", d$session)
rows(own[c("method", "condition", "participant", "threshold")], "thresholds.csv"); ours <- whole(d[c("participant", "condition", "session", "task", "phase")], NULL); unlink("thresholds.csv")
for (s in c("early", "late")) { wide <- tapply(d$threshold[d$session == s], list(d$participant[d$session == s], d$condition[d$session == s]), mean)
  same("a session's thresholds", line(ours[grepl(paste0("^pairs by t of threshold by staircase in ", s, " by condition"), ours$test), ], "condition: x - y")$p, t.test(wide[, 1], wide[, 2], paired = TRUE)$p.value) }
d$y <- d$threshold; rows(d[names(d) != "task"])
if (!any(grepl("session (early, late): averaged over", told(compare("y", table.of("trials.csv"), "y"))$note, fixed = TRUE))) fault("another program's sessions are averaged without a word")
d$phase <- rep(c("before", "after"), length.out = nrow(d))
d$percent_correct <- rnorm(nrow(d)); rows(d[c("participant", "condition", "percent_correct")], "identification.csv"); ours <- whole(d[names(d) %in% c("participant", "condition", "phase")], NULL); unlink("identification.csv")
if (!any(grepl("phase (before, after): all trials together", ours$note, fixed = TRUE))) fault("another program's runs are pooled without a word")
d <- expand.grid(trial = 1:3, participant = person(8), stringsAsFactors = FALSE)
d$task <- "rate"; d$session <- "main"; d$phase <- "main"; d$condition <- "c"; d$stimulus <- "s"; d$parts <- "ref|low|ref|mid"
d$ref <- ifelse(d$participant == "05", 70, 97); d$low <- round(20 + 9 * rnorm(24)); d$mid <- round(60 + 9 * rnorm(24))
ours <- whole(d, c("low", "mid", "ref"))
if (!any(ours$effect == "object" & ours$p < 0.001)) fault("objects side by side are not compared")
if (!any(grepl("by 05: not excluded", ours$note))) fault("a low hidden reference is not told")
own <- aggregate(cbind(low, mid, ref) ~ participant, d, mean)
same("objects", line(ours, "object: low - mid")$p, t.test(own$low, own$mid, paired = TRUE)$p.value)
d <- expand.grid(trial = 1:2, participant = person(8), condition = c("c1", "c2", "c3"), stringsAsFactors = FALSE)
d$task <- "rate"; d$session <- "main"; d$phase <- "main"; d$stimulus <- ""; d$parts <- ""; d$effort <- sample(1:7, nrow(d), TRUE)
ours <- whole(d, "effort", "effort", data.frame(participant = person(8), group = rep(c("g", "h"), 4)))
wide <- tapply(as.numeric(d$effort), list(d$participant, d$condition), mean)
same("seven points", line(ours, "condition")$p, friedman.test(wide)$p.value)
same("groups of the table of people", line(ours, "group: g - h")$p, exact.p(rowMeans(wide)[c(1, 3, 5, 7)], rowMeans(wide)[c(2, 4, 6, 8)]))
if (nrow(line(ours, "group")) > 0) fault("two groups have a second test")
if (sum(ours$test == "interactions of effort" & ours$effect == "condition:group" & ours$kind == "not made") != 1) fault("that ranks leave out interactions is not told once")
# Two levels have one test by ranks, beside a factor of more; over scales each factor has its own.
d$stimulus <- rep(c("s", "t"), each = 8, length.out = nrow(d)); d <- rbind(d, transform(d, stimulus = ifelse(stimulus == "s", "t", "s"))); d$effort <- sample(1:7, nrow(d), TRUE); d$calm <- sample(1:7, nrow(d), TRUE)
ours <- whole(d, c("effort", "calm"), c("effort", "calm")); own <- line(ours, "stimulus: s - t")
if (any(ours$statistic == "chi-squared" & ours$effect == "stimulus") || nrow(own) != 2) fault("two levels have two tests")
if (!any(ours$test == "Friedman's test of effort by condition")) fault("a test is named after factors that it lacks")
for (i in 1:2) { same("two levels over scales", own$p_across[i], p.adjust(own$p, "holm")[i]); own.three <- line(ours, "condition"); same("three levels over scales", own.three$p_across[i], p.adjust(own.three$p, "holm")[i]) }
# Whose group is not known is in no group; of one known group, or none, everybody is compared.
people <- data.frame(participant = person(8)[-8], group = c("g", "h", "g", "h", "g", "h", "")); d <- d[d$stimulus == "s", ]
for (kind in list("effort", character())) {
  ours <- whole(d, "effort", kind, people); g <- rowMeans(tapply(d$effort, list(d$participant, d$condition), mean))
  if (!any(grepl("07 (group not known), 08 (group not known): left out", ours$note, fixed = TRUE)) || !all(line(ours, "group: g - h")$n == 6) || !all(line(ours, "condition")$n == 6)) fault("who has no group is in a test by group, or goes without a word")
  same("known groups", line(ours, "group: g - h")$p, if (length(kind) > 0) exact.p(g[c(1, 3, 5)], g[c(2, 4, 6)]) else t.test(g[c(1, 3, 5)], g[c(2, 4, 6)], var.equal = TRUE)$p.value)
}
if (!any(grepl("unweighted mean of the groups; SD within groups", ours$note))) fault("differences beside groups are not said to be of groups alike")
ours <- whole(d, "effort", "effort", transform(people, group = rep(c("g", ""), length.out = 7)))
if (any(grepl("group", ours$test)) || line(ours, "condition")$n != 8) fault("one known group is compared with none")
d$task <- "choose"; d$choice <- sample(c("A", "B"), nrow(d), TRUE); d$correct <- d$level_db <- ""; rows(d); rows(data.frame(participant = person(8), group = c("g", "h", "g", "h", "g", "h", "", "")), "participants.csv")
ours <- told(choices("t", "trials.csv"))
if (any(grepl("group=($| )|NA", ours$effect)) || line(ours, "all")$n != 8 || line(ours, "group=g")$n != 3 || !any(grepl("07 (group not known), 08 (group not known): left out", ours$note, fixed = TRUE))) fault("shares of no group")
if (any(grepl("variance", ours$test))) fault("points are taken as scores")
# One of several who differs is no effect.
d <- expand.grid(trial = 1:4, condition = c("c1", "c2"), participant = person(14), stringsAsFactors = FALSE); d$y <- as.numeric(d$participant == "03" & d$condition == "c1" & d$trial < 3); rows(d)
ours <- told({ pairs.test("t", "trials.csv", "y", "condition", by = "ranks"); friedman("t", "trials.csv", "y", "condition") })
if (!all(is.na(ours$p)) || !all(is.na(ours$effect_size)) || !all(grepl("of 14 people 1 differs", ours$note))) fault("one person who differs has an effect:", ours$note)
# A trial that ran out of time is no answer: how often it was is compared, by rows that stay in trials.csv.
d <- expand.grid(trial = 1:6, participant = person(7), condition = c("c1", "c2"), stringsAsFactors = FALSE)
d$task <- "rate"; d$session <- "main"; d$phase <- "main"; d$stimulus <- ""; d$parts <- ""; d$effort <- round(100 * runif(nrow(d)))
d$ran_out <- ifelse(runif(nrow(d)) < ifelse(d$condition == "c2", 0.6, 0.1) & d$trial > 1, 1, 0); d$effort[d$ran_out == 1] <- NA
ours <- whole(d, "effort"); late <- tapply(d$ran_out, list(d$participant, d$condition), mean); effort <- tapply(d$effort, list(d$participant, d$condition), mean, na.rm = TRUE)
# Shares of thirds: equal differences are ties, whatever their last binary digit is.
same("ran out", ours$p[grepl("ran out of time in main", ours$test)], exact.p(round(late[, 1] - late[, 2], 9)))
same("answers in time", line(ours[!grepl("ran out", ours$test), ], "condition: c1 - c2")$p, t.test(effort[, 1], effort[, 2], paired = TRUE)$p.value)
# Over scales: scores, points, and points of two conditions, which are compared as a pair alone; interactions are of scores.
d <- expand.grid(condition = c("x", "y"), stimulus = c("s", "t"), participant = person(9), stringsAsFactors = FALSE); d$task <- "rate"; d$session <- "main"; d$phase <- "main"; d$parts <- ""
d$`ease of use` <- round(rnorm(36, 50, 9) + 5 * (d$condition == "y"), 2); d$rough <- round(rnorm(36, 50, 9), 2); d$agree <- sample(1:5, 36, TRUE) + (d$condition == "y")
ours <- whole(d, c("ease of use", "rough", "agree"), "agree"); three <- line(ours, "condition"); pair <- ours[ours$effect == "condition: x - y" & ours$statistic == "V", ]
for (i in 1:2) same("over scales and ranks", three$p_across[i], p.adjust(c(three$p, pair$p), "holm")[i])
same("ranks over scales", pair$p_across, p.adjust(c(three$p, pair$p), "holm")[3])
if (!identical(unique(c(three$across, pair$across)), "Holm, 3 tests over scales") || !all(line(ours[ours$kind == "test", ], "condition:stimulus")$across == "Holm, 2 tests over scales; without agree")) fault("the tests that are corrected together are not told")
# What is averaged over counts level by level, though a person has more rows of one.
d <- expand.grid(level_db = c(0, 6), condition = c("c1", "c2"), participant = person(8), stringsAsFactors = FALSE); d$value <- exp(rnorm(32, 2)); d <- rbind(d, d[c(2, 2, 5, 7, 7), ]); d$value <- round(d$value, 3); rows(d)
wide <- with(aggregate(log10(value) ~ ., d, mean), tapply(`log10(value)`, list(participant, condition), mean))
same("levels that are averaged over", line(told(compare("magnitudes", table.of("trials.csv"), "value", "magnitudes")), "condition: c1 - c2")$difference, median(wide[, 1] - wide[, 2]))
# Shares of several alternatives are one question; groups have their Levene's test, around medians.
d <- expand.grid(trial = 1:9, participant = person(12), condition = c("c1", "c2"), stringsAsFactors = FALSE)
d$task <- "choose"; d$session <- "main"; d$phase <- "main"; d$stimulus <- ""; d$parts <- "A|B|C"; d$correct <- ""; d$level_db <- ""
d$choice <- ifelse(runif(nrow(d)) < ifelse(d$condition == "c1", 0.7, 0.3), "A", sample(c("B", "C"), nrow(d), TRUE))
ours <- whole(d, character()); own <- ours[grepl("^pairs by ranks of choice=", ours$test), ]
if (nrow(own) != 3) fault("alternatives are compared in", nrow(own), "lines")
for (i in 1:3) same("over alternatives", own$p_across[i], p.adjust(own$p, "holm")[i])
d$y <- rnorm(nrow(d)); d$group <- ifelse(as.integer(d$participant) < 6, "g", "h"); rows(d)
ours <- told(anova.test("t", "trials.csv", "y", "condition", between = "group")); own <- tapply(d$y, d$participant, mean); g <- tapply(d$group, d$participant, `[`, 1)
away <- abs(own - tapply(own, g, median)[g])
same("Levene", line(ours, "groups homogeneity")$p, t.test(away[g == "g"], away[g == "h"], var.equal = TRUE)$p.value)
# Pointing at a grid: conditions differ by how far answers to a target scatter.
d <- expand.grid(trial = 1:3, target_column = 1:3, target_row = 1:2, condition = c("c1", "c2"), participant = person(6), stringsAsFactors = FALSE)
d$task <- "locate"; d$session <- "main"; d$phase <- "main"; d$stimulus <- paste0(d$target_row, ",", d$target_column); d$parts <- ""
d$x <- d$target_column / 4 + rnorm(nrow(d)) / 9; d$y <- d$target_row / 3 + rnorm(nrow(d)) / 9
ours <- whole(d, character()); both <- aggregate(cbind(x, y) ~ target_column + target_row + condition + participant, d, var)
wide <- tapply(sqrt(both$x + both$y), list(both$participant, both$condition), mean)
same("scatter", line(ours[grepl("^pairs by t of variable error", ours$test), ], "condition: c1 - c2")$p, t.test(wide[, 1], wide[, 2], paired = TRUE)$p.value)
# One score of each person: groups are all there is.
d <- data.frame(participant = person(15), group = rep(c("g", "h", "h"), 5), y = rnorm(15)); rows(d)
same("residuals of groups", line(told(anova.test("t", "trials.csv", "y", between = "group")), "normality of the participants' means, as deviations from the group's mean")$p, shapiro.test(residuals(lm(y ~ group, d)))$p.value)
# Pairs: the matrix of means, and a map that has the distances of points in a plane.
at <- cbind(c(0, 3, 0, 5), c(0, 0, 4, 5)); two <- combn(4, 2); names(at) <- NULL
d <- expand.grid(pair = 1:6, participant = person(3), stringsAsFactors = FALSE)
d$stimulus <- paste(letters[two[1, d$pair]], "&", letters[two[2, d$pair]]); d$difference <- apply(at[two[1, d$pair], ] - at[two[2, d$pair], ], 1, function(x) sqrt(sum(x^2)))
d$task <- "rate"; d$session <- "main"; d$phase <- "main"; d$condition <- "c"; d$parts <- sub(" & ", "|", d$stimulus)
whole(d, "difference")
map <- read.csv("mds.csv", comment.char = "#"); m <- read.csv("similarity.csv", comment.char = "#")
same("a matrix", m$b[m$stimulus == "a"], 3)
if (max(abs(dist(map[c("x", "y")]) - dist(at))) > 1e-9 || map$stress[1] > 1e-9) fault("the map is another one")
# Distances that grow faster than steps have no map in two dimensions; sessions have their own rows.
d$difference <- (two[2, d$pair] - two[1, d$pair])^1.5; invisible(whole(d, "difference"))
if (!all(is.na(read.csv("mds.csv", comment.char = "#")$y))) fault("that there is no map in two dimensions is not told")
if ("session" %in% names(read.csv("mds.csv", comment.char = "#"))) fault("one session has a column")
invisible(whole(rbind(d, transform(d, session = "later", difference = difference / 2)), "difference"))
for (file in c("mds.csv", "similarity.csv")) if (!setequal(read.csv(file, comment.char = "#")$session, c("main", "later"))) fault("sessions are not told apart in", file)
# Right and wrong answers, and no level: a table of another program.
d <- expand.grid(trial = 1:9, participant = person(6), condition = c("c1", "c2"), stringsAsFactors = FALSE)
d$correct <- as.integer(runif(nrow(d)) < ifelse(d$condition == "c2", 0.9, 0.6)); wide <- tapply(d$correct, list(d$participant, d$condition), mean)
ours <- line(whole(d, character()), "condition: c1 - c2")
same("right answers", ours$p, t.test(wide[, 1], wide[, 2], paired = TRUE)$p.value)
if (!identical(ours$size, "d_z")) fault("the effect of pairs is called", ours$size)
# A task is named, and no session, level or right answer.
d$task <- "choose"; d$choice <- ifelse(d$correct == 1, "A", "B"); d$correct <- NULL; ours <- whole(d, character()); wide <- tapply(d$choice == "A", list(d$participant, d$condition), mean)
same("a task without a session", line(ours[grepl("^pairs", ours$test), ], "condition: c1 - c2")$p, exact.p(round(wide[, 1] - wide[, 2], 9)))
d$task <- "rate"; d$comfort <- 9 * d$trial + runif(nrow(d))
if (!any(grepl("variance of comfort by", whole(d, "comfort")$test))) fault("a scale without a session is not compared")
# A questionnaire of another program, in whole numbers from 1 to 7: ranks.
d <- data.frame(participant = person(21), group = rep(c("g", "h", "k"), 7), comfort = sample(1:5, 21, TRUE), level = round(100 * runif(21)))
ours <- whole(d, c("comfort", "level"))
same("others' points", line(ours[grepl("of comfort by", ours$test), ], "group")$p, kruskal.test(d$comfort, d$group)$p.value)
if (!any(grepl("variance of level by", ours$test))) fault("scores are taken as points")
own <- line(results[grepl("comfort", results$test), ], "group=h")
if (own$statistic != "median" || own$n != 7) fault("groups whose medians are compared are told by means"); same("a median", own$value, median(d$comfort[d$group == "h"]))
# Who has no value at all is named beside who lacks a level, in choices, too.
d <- expand.grid(condition = c("x", "y", "z"), participant = person(9), stringsAsFactors = FALSE); d$warmth <- round(30 * runif(27), 1) + 8
d$warmth[d$participant == "04" | (d$participant == "07" & d$condition == "x")] <- NA
left <- line(whole(d, "warmth"), "left out")
if (nrow(left) != 1 || left$n != 7 || !grepl("07, 04$", left$note)) fault("who has no value is not named:", left$note)
d$choice <- ifelse(d$participant == "02", NA, sample(c("hot", "cold"), 27, TRUE)); d$warmth <- NULL
if (sum(grepl("lacking of 02$", whole(d, character())$note)) < 2) fault("who never chose is not named")
# Seven points are ranks, however numbers are written.
d$choice <- NULL; d$grip <- sprintf("%.1f", sample(1:7, 27, TRUE)); tests <- unique(whole(d, "grip")$test); d$grip <- as.integer(d$grip)
if (!any(grepl("Friedman's", tests)) || !identical(tests, unique(whole(d, "grip")$test))) fault("4.0 and 4 call for two models")
# Levels that were only felt in one condition are in no mean of conditions, though everybody has them; a person who lacks one of these is left out of nothing.
d <- expand.grid(level_db = c(0, 3, 6, 9, 12), condition = c("glove", "pad"), participant = person(9), stringsAsFactors = FALSE)
d <- d[!(d$condition == "glove" & d$level_db == 0) & !(d$condition == "pad" & d$level_db == 12) & !(d$participant == "03" & d$level_db == 0), ]
d$value <- round(exp(d$level_db / 4 + 0.3 * (d$condition == "pad") + 0.2 * rnorm(nrow(d))), 3); rows(d); common <- d[!(d$level_db %in% c(0, 12)), ]
wide <- with(aggregate(log10(value) ~ condition + participant, common, mean), tapply(`log10(value)`, list(participant, condition), mean))
ours <- told(compare("magnitudes", table.of("trials.csv"), "value", "magnitudes")); own <- line(ours, "condition: glove - pad")
same("levels of both conditions", own$difference, median(wide[, 1] - wide[, 2]))
if (!identical(own$n, 9L) || !any(grepl("^level_db: 0, 12: left out, not with all of condition$", ours$note))) fault("levels of one condition alone are averaged over:", ours$note)
# Of other programs' tables, time-outs are compared without sessions.
d <- expand.grid(trial = 1:6, participant = person(7), condition = c("c1", "c2"), stringsAsFactors = FALSE); d$effort <- round(100 * runif(nrow(d)))
d$ran_out <- ifelse(runif(nrow(d)) < ifelse(d$condition == "c2", 0.6, 0.1) & d$trial > 1, 1, 0); d$effort[d$ran_out == 1] <- NA
ours <- whole(d, "effort"); late <- tapply(d$ran_out, list(d$participant, d$condition), mean)
same("ran out, of other programs", ours$p[grepl("share of trials that ran out of time by condition", ours$test)], exact.p(round(late[, 1] - late[, 2], 9)))
# Nothing is compared between people whose means are of unequal conditions: here group h is the later one, and nobody differs by group.
d <- expand.grid(condition = c("c1", "c2", "c3"), participant = person(12), stringsAsFactors = FALSE); d$group <- ifelse(as.integer(d$participant) <= 6, "g", "h"); d$y <- rnorm(36, 60 * (d$condition == "c3"))
d <- d[!(d$group == "g" & d$condition == "c3" & d$participant != "02") & !(d$group == "h" & d$condition == "c1" & d$participant != "08"), ]; rows(d)
for (kind in c("scores", "ranks")) { ours <- told(compare("y", table.of("trials.csv"), "y", kind)); if (!all(is.na(ours$p)) || !any(grepl("^group: not tested.*condition", ours$note))) fault("groups are compared by means of other conditions") }
# Stimuli that nobody lacks are compared by the conditions that each participant had with all of them.
d <- merge(d, data.frame(stimulus = c("s", "t"))); d$y <- round(d$y + rnorm(nrow(d)), 3); d <- d[!(d$participant == "02" & d$condition == "c3" & d$stimulus == "t"), ]; rows(d); ours <- told(compare("y", table.of("trials.csv"), "y"))
m <- d[!(d$participant == "02" & d$condition == "c3"), ]; wide <- tapply(m$y, list(m$participant, m$stimulus), mean)
same("levels that each has", line(ours, "stimulus: s - t")$p, t.test(wide[, 1], wide[, 2], paired = TRUE)$p.value)
if (any(grepl("group", ours$effect)) || !any(grepl("those that each has", ours$note))) fault("what is averaged over is not told")
# Stimuli of one condition alone are averaged over; who lacks one is named and left out, as of other programs' sessions.
d <- expand.grid(stimulus = c("u 1", "u 2", "v 1", "v 2"), participant = person(8), stringsAsFactors = FALSE); d$condition <- substr(d$stimulus, 1, 1); d$y <- rnorm(32) + 9 * (d$stimulus == "v 2"); d <- d[-12, ]; rows(d)
wide <- with(d[d$participant != "03", ], tapply(y, list(participant, condition), mean)); ours <- told(compare("y", table.of("trials.csv"), "y"))
same("stimuli of a condition", line(ours, "condition: u - v")$p, t.test(wide[, 1], wide[, 2], paired = TRUE)$p.value)
if (!any(grepl("of 03$", line(ours, "left out")$note))) fault("who lacks what is averaged over goes without a word")
d$session <- ifelse(grepl("1", d$stimulus), "one", "two"); d$stimulus <- "s"; d$group <- ifelse(as.integer(d$participant) %% 2 == 0, "g", "h"); rows(d)
if (!all(line(told(compare("y", table.of("trials.csv"), "y")), "group: g - h")$n == 7)) fault("one session counts as two")
d$session <- paste(d$participant, d$session); rows(d)
if (!all(line(told(compare("y", table.of("trials.csv"), "y")), "group: g - h")$n == 8)) fault("sessions with names of their own are taken as lacking")
d <- expand.grid(target_column = 1:2, trial = 1:3, condition = c("c1", "c2"), participant = person(8), stringsAsFactors = FALSE); d$target_row <- 1; d$x <- runif(96) + d$target_column * runif(96); d$y <- runif(96)
ours <- whole(d[!(d$participant == "05" & d$condition == "c2" & d$target_column == 2), ], character()); own <- ours[grepl("variable error", ours$test), ]
if (!any(grepl("of 05$", own$note)) || !all(line(own, "condition: c1 - c2")$n == 7)) fault("errors of unequal targets are compared")
d <- expand.grid(target = c("near", "far"), condition = c("c1", "c2"), participant = person(8), stringsAsFactors = FALSE); d$distance <- runif(32) + 9 * (d$target == "far"); d <- d[-4, ]; rows(d, "places.csv")
ours <- whole(d[c("participant", "condition")], character()); own <- ours[grepl("distance from the target", ours$test), ]; unlink("places.csv")
if (!any(grepl("of 01$", own$note)) || !all(line(own, "condition: c1 - c2")$n == 7) || !any(grepl("target (2): averaged over", own$note, fixed = TRUE))) fault("distances from unequal targets are compared")
# Values below 0 are no magnitudes: they are compared as they are.
d <- expand.grid(trial = 1:2, condition = c("c1", "c2"), participant = person(9), stringsAsFactors = FALSE); d$value <- round(rnorm(36, 3 * (d$condition == "c2") - 2), 2); d$value[5] <- 0; wide <- tapply(d$value, list(d$participant, d$condition), mean)
ours <- whole(d, character())
same("values below 0", line(ours, "condition: c1 - c2")$p, t.test(wide[, 1], wide[, 2], paired = TRUE)$p.value)
if (any(grepl("magnitudes? of 0|log10", c(ours$note, ours$test))) || !any(grepl("values below 0: [1-9]", ours$note))) fault("values below 0 are called magnitudes")
# Medians that are the same differ by 0; who is in no model as lme4 is lacking.
d <- data.frame(participant = person(6), group = rep(c("g", "h", "h"), 2), y = c(0.2, 0.1, 0.5, 0.4, 0, 0.9)); rows(d); ours <- line(told(pairs.test("t", "trials.csv", "y", between = "group", by = "ranks")), "group: g - h")
if (!identical(abs(ours$difference), 0)) fault("equal medians differ by", ours$difference)
d <- expand.grid(condition = c("x", "y"), participant = person(5)); d$y <- rnorm(10); rows(d[-1, ])
if (!requireNamespace("lme4", quietly = TRUE) && !any(grepl("lme4", told(anova.test("t", "trials.csv", "y", "condition"))$note))) fault("that lme4 is lacking is not told")
# Four factors: R numbers A:B, A:C, B:C, A:D.
if (requireNamespace("lme4", quietly = TRUE)) {
  d <- expand.grid(a = c("a1", "a2", "a3"), b = c("b1", "b2"), c = c("c1", "c2"), participant = person(10), stringsAsFactors = FALSE)
  d$group <- ifelse(as.integer(d$participant) %% 2 == 0, "g", "h"); d$y <- rnorm(120) + rnorm(10)[as.integer(d$participant)] + rnorm(30)[as.integer(interaction(d$a, d$participant))]; rows(d[-1, ])
  ours <- told(anova.test("t", "trials.csv", "y", c("a", "b", "c"), between = "group"))
  for (effect in c("a:b", "a:c", "b:c", "a:group", "b:group", "c:group", "a:b:c", "a:b:group", "a:c:group", "b:c:group")) if (isTRUE(mixed.line(ours, effect)$df1 != if (grepl("a", effect)) 2 else 1)) fault("the mixed model's", effect, "has", mixed.line(ours, effect)$df1, "degrees of freedom")
}
# A level that one person alone has is left out by name, and takes the factor from nobody; who lacks levels, too.
d <- expand.grid(stimulus = c("high", "low"), condition = c("felt", "glass", "sand"), participant = person(20), stringsAsFactors = FALSE)
d$y <- rnorm(120, 30 * (d$condition == "sand")); d <- d[!(d$participant < "10" & d$condition == "sand" & d$stimulus == "high"), ]; whole.rows <- d
stray <- function(who, condition, stimulus = "low") data.frame(participant = who, condition, stimulus, y = 44)
rows(rbind(d, stray("02", "tin"), stray("21", "glass"))); ours <- told(compare("y", table.of("trials.csv"), "y")); m <- d[d$participant >= "10", ]; wide <- tapply(m$y, list(m$participant, m$stimulus), mean)
same("beside a stray level", line(ours, "stimulus: high - low")$p, t.test(wide[, 1], wide[, 2], paired = TRUE)$p.value)
if (nrow(line(ours, "condition: felt - sand")) != 1 || !any(grepl("condition: tin is of 02 alone: left out", ours$note)) || !any(grepl("lacking of .*09, 21$", ours$note))) fault("one row of a level takes its factor from all")
# Of what is averaged over the same levels are compared of each, though somebody has none of them; a level that nobody has whole counts for nobody.
rows(rbind(d, stray(c("02", "03"), "tin"), stray("21", "glass"))); ours <- told(compare("y", table.of("trials.csv"), "y"))
m <- d[d$condition != "sand" | d$participant >= "10", ]; wide <- tapply(m$y, list(m$participant, m$stimulus), mean); own <- line(ours, "stimulus: high - low")
same("levels that each has whole", own$p, t.test(wide[, 1], wide[, 2], paired = TRUE)$p.value)
if (!identical(own$n, 20L) || !any(grepl("lacking of 21$", ours$note))) fault("who has nothing whole switches the rule off")
for (words in c("condition: sand left out of 01, 02, .*, 09, who lack it elsewhere", "condition: tin left out of 02, 03, who", "^condition: of 21 participants 2 have all its levels: averaged")) if (!any(grepl(words, ours$note))) fault("not told:", words)
# Where each person had a stimulus in one condition, that is said.
rows(d[(d$stimulus == "high") == ((d$condition == "felt") == (as.integer(d$participant) %% 2 == 0)) & d$condition != "sand", ])
if (!any(grepl("stimulus: .* unequal levels of people", told(compare("y", table.of("trials.csv"), "y"))$note))) fault("conditions are compared over other stimuli without a word")
# A group of one person is not tested, nor is one that a person shares with another.
d <- expand.grid(trial = 1:2, condition = c("x", "y"), participant = person(9), stringsAsFactors = FALSE); d$y <- rnorm(36); d$group <- ifelse(d$participant == "01", "solo", ifelse(d$participant < "05", "g", "h")); rows(d)
ours <- told(compare("y", table.of("trials.csv"), "y"))
if (any(grepl("solo", ours$effect)) || !any(grepl("solo is of 01 alone", ours$note)) || line(ours, "group: g - h")$n != 8) fault("a group of one person is tested")
rows(d[d$group != "h", ]); ours <- told(compare("y", table.of("trials.csv"), "y"))
if (any(grepl("group", ours$effect)) || !any(grepl("group: solo of one participant alone: not tested", ours$note)) || line(ours, "condition: x - y")$n != 4) fault("two groups, of which one is of one person, are tested")
# Nor is one of which others lack a level: each person counts alike then, and of three groups it is left out.
lost <- d[!(d$participant %in% c("03", "04") & d$condition == "y") & d$group != "solo", ]; lost$group[lost$participant > "07"] <- "k"
for (isTwo in c(FALSE, TRUE)) { if (!isTwo) rows(lost); ours <- told(compare("y", table.of("trials.csv"), "y")); rows(lost[lost$group != "k", ])
  if (any(grepl("- g|g -", ours$effect)) || !any(grepl(if (isTwo) "group: g n = 1, h n = 3 with all levels: not tested" else "group: g n = 1, h n = 3, k n = 2 with all levels: g left out", ours$note)) || line(ours, "condition: x - y")$n != (if (isTwo) 4 else 5) || any(grepl("unweighted", ours$note)) == isTwo) fault("a group of whom one person is left is tested") }
d <- d[d$group != "solo", ]; d$group[d$participant == "07" & d$trial == 2] <- "g"; rows(d); ours <- told(compare("y", table.of("trials.csv"), "y"))
if (line(ours, "group: g - h")$n != 7 || !any(startsWith(ours$note, "07 (in several groups): left out"))) fault("who is in two groups takes the test of groups away")
d$choice <- sample(c("A", "B"), nrow(d), TRUE); rows(d); if (line(told(choices("t", "trials.csv")), "group=h")$n != 4) fault("who is in two groups is in both")
# Two words that are crossed are two factors, though only some have a name.
d <- expand.grid(stimulus = c("grit=60 wet", "grit=60 dry", "1000 wet", "1000 dry"), participant = person(7), stringsAsFactors = FALSE); d$y <- rnorm(28); rows(d); wide <- tapply(d$y, list(d$participant, sub(".* ", "", d$stimulus)), mean)
same("two words", line(told(compare("y", table.of("trials.csv"), "y")), "stimulus.2: dry - wet")$p, t.test(wide[, 1], wide[, 2], paired = TRUE)$p.value)
# Likenesses: distances are of the scale's end, so that the most alike are not at one place; the stress is Kruskal's.
d <- expand.grid(pair = 1:6, participant = person(3), stringsAsFactors = FALSE); d$stimulus <- paste(letters[two[1, d$pair]], "&", letters[two[2, d$pair]]); d$alike <- c(77, 60, 41, 72, 52, 66)[d$pair]
d$task <- "rate"; d$session <- "main"; d$phase <- "main"; d$condition <- "c"; d$parts <- sub(" & ", "|", d$stimulus); invisible(whole(d, "alike"))
map <- read.csv("mds.csv", comment.char = "#"); far <- 100 - c(77, 60, 41, 72, 52, 66); shown <- as.vector(dist(map[c("x", "y")]))
same("Kruskal's stress", map$stress[1], sqrt(sum((shown - far)^2) / sum(shown^2)))
if (!all(map$distance == "100 - mean")) fault("how likeness becomes distance is not told")
# Levels that have a function are averaged over by name; places of other programs' targets are named as they are.
d <- expand.grid(trial = 1:3, stimulus = c("1", "2"), condition = c("c1", "c2"), participant = person(7), stringsAsFactors = FALSE); d$choice <- sample(c("A", "B"), nrow(d), TRUE); rows(data.frame(participant = "01", condition = "c1", threshold = 1, jnd = 1), "psychometric-stimuli.csv")
ours <- whole(d, character()); unlink("psychometric-stimuli.csv"); if (!any(grepl("stimulus (2): averaged over, level by level", ours$note[grepl("choice", ours$test)], fixed = TRUE))) fault("levels are averaged over without a word")
if (any(grepl("against chance", ours$test))) fault("shares of levels that have a function are tested against chance"); if (!any(grepl("against chance", whole(d, character())$test))) fault("shares are not tested against chance")
for (other in c(FALSE, TRUE)) { # thresholds among other levels differ by what was played
  d <- expand.grid(trial = 1:2, stimulus = c("1", "2"), condition = c("c1", "c2"), participant = person(7), stringsAsFactors = FALSE); if (other) d$stimulus <- ifelse(d$condition == "c2", paste0("9", d$stimulus), d$stimulus)
  d$choice <- sample(c("A", "B"), nrow(d), TRUE); fits <- expand.grid(condition = c("c1", "c2"), participant = person(7), stringsAsFactors = FALSE); fits$threshold <- rnorm(14); fits$jnd <- rnorm(14); rows(fits, "psychometric-stimuli.csv")
  ours <- whole(d, character()); if (any(ours$test == "pairs by t of threshold by condition") == other || any(ours$note == "other levels in each condition") != other || !any(ours$test == "pairs by t of half interquartile range by condition")) fault("thresholds among other levels are compared, or of the same are not")
}
unlink("psychometric-stimuli.csv")
d <- expand.grid(trial = 1:2, target_x = c(100, 700), target_y = c(50, 90), participant = person(6)); d$target_column <- d$target_x %/% 300 + 1; d$target_row <- d$target_y %/% 60 + 1; d$x <- rnorm(48); d$y <- rnorm(48)
if (nrow(line(whole(d, character()), "target_x: 100 - 700")) != 2) fault("which column is 1 is not told")
# What the mixed model has is told.
if (requireNamespace("lme4", quietly = TRUE)) { rows(whole.rows); if (!endsWith(mixed.line(told(anova.test("t", "trials.csv", "y", c("condition", "stimulus"))), "model")$note, "random (1 | participant) + (1 | participant:condition) + (1 | participant:stimulus)")) fault("a mixed model without its random part") }
# A pair that cannot be tested counts in no correction, and that is said.
d <- expand.grid(condition = c("x", "y", "z"), participant = person(6), stringsAsFactors = FALSE); d$y <- as.integer(d$participant) + 10 * (d$condition == "z"); rows(d)
ours <- told(pairs.test("t", "trials.csv", "y", "condition", by = "ranks"))
same("Holm of two of three", line(ours, "condition: x - z")$p_corrected, 0.0625)
if (line(ours, "condition: x - z")$correction != "Holm, 2 tests") fault("a smaller family goes without a word")
# Scales that could not be tested are named, though one is left, or though they have no value.
d <- expand.grid(condition = c("x", "y", "z"), participant = person(7), stringsAsFactors = FALSE); d$task <- "rate"; d$session <- "main"; d$phase <- "main"; d$stimulus <- d$parts <- ""
d$effort <- rep(c(1, 4, 6), 7); d$calm <- rep(c(2, 1, 5), 7); d$hurry <- 3; d$lost <- ""
ours <- whole(d, c("effort", "calm", "hurry", "lost"), c("effort", "calm", "hurry"))
if (sum(ours$across == "Holm, 2 tests over scales; without hurry, lost") != 2) fault("scales without a test are not named")
ours <- whole(d, c("effort", "hurry", "lost"), c("effort", "hurry"))
if (sum(ours$across == "Holm, 1 test over scales; without hurry, lost") != 1) fault("one scale that is left says nothing of the others")
# Pairs of several alternatives are one family, of the p of the tests themselves.
d <- expand.grid(trial = 1:9, participant = person(12), condition = c("c1", "c2", "c3"), stringsAsFactors = FALSE); d$task <- "choose"; d$session <- "main"; d$phase <- "main"; d$stimulus <- d$correct <- d$level_db <- ""; d$parts <- "A|B|C"
d$choice <- ifelse(runif(nrow(d)) < ifelse(d$condition == "c1", 0.8, 0.2), "A", sample(c("B", "C"), nrow(d), TRUE)); ours <- whole(d, character())
own <- ours[grepl("^pairs by ranks of choice=", ours$test), ]; for (i in 1:9) same("pairs over alternatives", own$p_across[i], p.adjust(own$p, "holm")[i])
if (!all(own$across == "Holm, 9 tests over alternatives")) fault("the pairs of alternatives are not one family")
# Who lacks a condition counts in the shares of conditions that they have alone.
lost <- d[!(d$participant == "04" & d$condition == "c2"), ]; rows(lost); ours <- told(choices("t", "trials.csv"))
if (line(ours, "A, all")$n != 11 || line(ours, "A, condition=c1")$n != 12 || !any(grepl("lacking of 04: left out of lines over what they lack", ours$note))) fault("shares against chance are of other conditions")
same("shares of who has all", line(ours, "A, all")$p, exact.p(as.vector(tapply(lost$choice == "A", lost$participant, function(x) 3 * sum(x) - length(x)))[-4]))
# NA is an answer where it is one, and no group.
d$choice <- sub("A", "NA", d$choice); d$group <- ifelse(d$participant < "03", "NA", ifelse(d$participant < "08", "g", "h")); rows(d); ours <- told(compare("choice=NA", table.of("trials.csv"), "choice=NA", "ranks", c("group", "condition")))
if (any(grepl("NA -|- NA$", ours$effect)) || !any(grepl("01 (group not known), 02 (group not known): left out", ours$note, fixed = TRUE)) || line(ours, "condition")$n != 10) fault("NA is a group, or no answer")
# Random effects without variance are named.
if (requireNamespace("lme4", quietly = TRUE)) {
  d <- expand.grid(condition = c("x", "y", "z"), stimulus = c("s", "t"), participant = person(9), stringsAsFactors = FALSE); own <- rnorm(9)[as.integer(d$participant)]; e <- residuals(lm(rnorm(54) ~ participant * condition + participant * stimulus, d)); d$y <- 3 * own + e; rows(d[-1, ])
  note <- mixed.line(told(anova.test("t", "trials.csv", "y", c("condition", "stimulus"))), "condition")$note
  if (!startsWith(note, "variance of participant:condition, its error, is estimated as 0 in the model with all effects")) fault("a singular model goes without a word:", note)
  # Of one without the effect, that it was that one.
  d <- expand.grid(condition = c("x", "y", "z"), participant = person(8), stringsAsFactors = FALSE); d$y <- 9 * (d$condition == "z") + rep(c(-1, 1), each = 12) + residuals(lm(rnorm(24) ~ participant, d)); rows(d[-1, ])
  note <- mixed.line(told(anova.test("t", "trials.csv", "y", "condition")), "condition")$note
  if (!grepl("variance of participant estimated as 0 in the model without condition", note)) fault("which model has no variance is not told:", note)
}
# People had two conditions; that nobody has an estimate of both makes no groups of them, beside all trials, or by a protocol that says so.
d <- expand.grid(condition = c("x", "y"), participant = person(8), stringsAsFactors = FALSE); d$percent_correct <- rnorm(16); one <- d[d$condition == ifelse(as.integer(d$participant) < 4, "x", "y"), ]
for (by.protocol in c(FALSE, TRUE)) {
  rows(one, "identification.csv"); ours <- whole(if (by.protocol) one[1:2] else d[1:2], character(), within = by.protocol)
  if (nrow(ours) != 1 || ours$note != "condition: of 8 participants 0 have all its levels: not tested") fault("whose estimates are lacking are taken as groups:", ours$test, ours$note)
}
if (!any(whole(one[1:2], character())$effect == "condition")) fault("groups by condition are not tested")
unlink("identification.csv")
# Two alternatives are one question.
d <- expand.grid(trial = 1:9, participant = person(9), condition = c("c1", "c2", "c3"), stimulus = c("s", "t"), stringsAsFactors = FALSE); d$task <- "choose"; d$session <- d$phase <- "main"; d$correct <- d$level_db <- ""; d$parts <- "A|B"
d$choice <- sample(c("A", "B"), nrow(d), TRUE); ours <- whole(d, character())
if (any(grepl("over alternatives", ours$across)) || !any(ours$effect == "condition")) fault("one alternative is corrected over alternatives")
d$y <- rnorm(nrow(d)); d$group <- ifelse(as.integer(d$participant) < 6, "g", "h"); rows(d); ours <- told(anova.test("t", "trials.csv", "y", c("condition", "stimulus"), between = "group"))
if (line(ours, "model")$note != "sums of squares of type III, sum contrasts" || nrow(line(ours, "normality of the participants' means, as deviations from the group's mean")) != 1) fault("how groups are compared is not told")
# Names in two parts. Means of levels are those of the people who are compared.
d <- expand.grid(condition = c("low-short", "low-long", "high-short", "high-long"), participant = person(4), stringsAsFactors = FALSE); d$y <- rnorm(16); ours <- whole(d, "y"); same("a mean", line(results, "condition.1=low")$value, mean(d$y[startsWith(d$condition, "low")]))
if (!("condition.1, condition.2: first and second part of low-short and so on" %in% ours$note)) fault("what condition.1 is goes without a word")
cat(faults, "faults\n")
quit(status = if (faults > 0) 1 else 0)
