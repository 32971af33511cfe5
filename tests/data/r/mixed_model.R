# Mixed models with missing laps and with groups, from lme4 and lmerTest (Kenward-Roger).
# Run in this folder: Rscript mixed_model.R. Writes mixed_model.csv.
suppressPackageStartupMessages({library(lmerTest); library(pbkrtest)})

out <- data.frame(name = character(), value = numeric())
put <- function(name, value) out[nrow(out) + 1, ] <<- list(name, as.numeric(value))
tell <- function(prefix, m) {
  plain <- sqrt(diag(as.matrix(vcov(m))))
  kr <- coef(summary(m, ddf = "Kenward-Roger"))
  for (effect in rownames(kr)) {
    name <- paste0(prefix, ".", effect)
    put(paste0(name, ".estimate"), kr[effect, "Estimate"])
    put(paste0(name, ".se"), plain[effect])
    put(paste0(name, ".se_kr"), kr[effect, "Std. Error"])
    put(paste0(name, ".df"), kr[effect, "df"])
    put(paste0(name, ".p"), kr[effect, "Pr(>|t|)"])
  }
  put(paste0(prefix, ".between"), attr(VarCorr(m)$participant, "stddev"))
  put(paste0(prefix, ".within"), sigma(m))
}
tight <- lmerControl(optimizer = "bobyqa", optCtrl = list(rhoend = 1e-10, maxfun = 1e5))

square <- read.csv("laps_square.csv")
square$condition <- relevel(factor(square$condition), ref = "limited")
square$place <- factor(square$place)
tell("square", lmer(log(lap_time_s) ~ condition + place + (1 | participant), square,
                    control = tight))
tell("missing", lmer(log(lap_time_s) ~ condition + (1 | participant), square, control = tight))

groups <- read.csv("laps_groups.csv")
groups$condition <- relevel(factor(groups$condition), ref = "limited")
groups$group <- factor(groups$group)
tell("groups", lmer(log(lap_time_s) ~ group * condition + (1 | participant), groups,
                    control = tight))
tell("between", lmer(log(lap_time_s) ~ group + (1 | participant),
                     groups[groups$condition != "baseline", ], control = tight))

six <- read.csv("laps_six_people.csv")
tell("six", lmer(log(lap_time_s) ~ factor(group) + (1 | participant), six, control = tight))

out$value <- signif(out$value, 15)
write.csv(out, "mixed_model.csv", row.names = FALSE, quote = FALSE)
