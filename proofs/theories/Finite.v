(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Finitely many indices k < n: choosing, the greatest and least value, a common small number. *)
From Coq Require Import Reals Lra Lia Classical.
Open Scope R_scope.

Lemma below_S n k : (k < S n)%nat -> k = n \/ (k < n)%nat.
Proof. lia. Qed.

(* Finitely many existing things can be chosen at once. *)
Lemma finite_choice {A : Type} (a : A) (P : nat -> A -> Prop) n :
  (forall k, (k < n)%nat -> exists x, P k x) -> exists f, forall k, (k < n)%nat -> P k (f k).
Proof.
  induction n as [| n IH]; intros H.
  - exists (fun _ => a). intros. lia.
  - destruct IH as [f F]; [intros k K; apply H; lia |].
    destruct (H n) as [x X]; [lia |].
    exists (fun k => if Nat.eq_dec k n then x else f k). intros k K.
    destruct (Nat.eq_dec k n) as [-> | D]; [exact X | apply F; lia].
Qed.

Lemma finite_max (P : nat -> Prop) (f : nat -> R) n : (exists k, (k < n)%nat /\ P k) ->
  exists m, (m < n)%nat /\ P m /\ forall k, (k < n)%nat -> P k -> f k <= f m.
Proof.
  induction n as [| n IH]; intros [k [K H]]; [lia |].
  destruct (classic (exists k, (k < n)%nat /\ P k)) as [E | E].
  - destruct (IH E) as [m [M [Pm L]]].
    destruct (classic (P n /\ f m < f n)) as [[Pn G] | G].
    + exists n. repeat split; [lia | exact Pn |]. intros j J Pj.
      destruct (below_S _ _ J) as [-> | J']; [lra |]. pose proof (L j J' Pj). lra.
    + exists m. repeat split; [lia | exact Pm |]. intros j J Pj.
      destruct (below_S _ _ J) as [-> | J']; [| now apply L].
      apply Rnot_lt_le. intros C. apply G. now split.
  - assert (K' : k = n). { destruct (below_S _ _ K) as [-> | K']; [reflexivity | exfalso; apply E; now exists k]. }
    subst. exists n. repeat split; [lia | exact H |]. intros j J Pj.
    destruct (below_S _ _ J) as [-> | J']; [lra | exfalso; apply E; now exists j].
Qed.

Lemma finite_min (P : nat -> Prop) (f : nat -> R) n : (exists k, (k < n)%nat /\ P k) ->
  exists m, (m < n)%nat /\ P m /\ forall k, (k < n)%nat -> P k -> f m <= f k.
Proof.
  intros H. destruct (finite_max P (fun k => - f k) n H) as [m [M [Pm L]]].
  exists m. repeat split; [exact M | exact Pm |]. intros k K Pk. pose proof (L k K Pk). lra.
Qed.

(* If for every k a property holds of all sufficiently small positive numbers, some positive number does for all k. *)
Definition small (P : R -> Prop) : Prop := exists e, 0 < e /\ forall d, 0 < d <= e -> P d.

Lemma small_and P Q : small P -> small Q -> small (fun d => P d /\ Q d).
Proof.
  intros [e [E H]] [f [F G]]. exists (Rmin e f). split; [now apply Rmin_pos |].
  intros d D. pose proof (Rmin_l e f). pose proof (Rmin_r e f). split; [apply H | apply G]; lra.
Qed.

Lemma small_weaken (P Q : R -> Prop) : (forall d, 0 < d -> P d -> Q d) -> small P -> small Q.
Proof. intros I [e [E H]]. exists e. split; [exact E |]. intros d D. apply I; [lra | now apply H]. Qed.

Lemma small_finite (P : nat -> R -> Prop) n :
  (forall k, (k < n)%nat -> small (P k)) -> small (fun d => forall k, (k < n)%nat -> P k d).
Proof.
  induction n as [| n IH]; intros H.
  - exists 1. split; [lra |]. intros. lia.
  - assert (A : small (fun d => P n d /\ forall k, (k < n)%nat -> P k d)).
    { apply small_and; [apply H; lia | apply IH; intros; apply H; lia]. }
    revert A. apply small_weaken. intros d _ [Pn L] k K.
    destruct (below_S _ _ K) as [-> | K']; [exact Pn | now apply L].
Qed.

(* Likewise for all sufficiently large natural numbers. *)
Definition late (P : nat -> Prop) : Prop := exists n, forall m, (n <= m)%nat -> P m.

Lemma late_and P Q : late P -> late Q -> late (fun m => P m /\ Q m).
Proof.
  intros [n H] [m G]. exists (Nat.max n m). intros l L. split; [apply H | apply G]; lia.
Qed.

Lemma late_finite (P : nat -> nat -> Prop) n :
  (forall k, (k < n)%nat -> late (P k)) -> late (fun m => forall k, (k < n)%nat -> P k m).
Proof.
  induction n as [| n IH]; intros H.
  - exists 0%nat. intros. lia.
  - destruct (late_and (P n) (fun m => forall k, (k < n)%nat -> P k m)) as [l L];
      [apply H; lia | apply IH; intros; apply H; lia |].
    exists l. intros m M k K. destruct (L m M) as [A B].
    destruct (below_S _ _ K) as [-> | K']; [exact A | now apply B].
Qed.
