(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* A pair that the checker shows to be a tie by a row is weakly Delaunay and not strictly, wherever in their rectangles the
   sites are that the block does not describe. *)
From Coq Require Import Reals Lra Lia ZArith NArith List Bool.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve CheckerTree Checker CheckerSound CheckerEnclosure.
From Dyadel Require Import CheckerEnclosureSound CheckerAlgebra CheckerAlgebraSound CheckerBlock CheckerBlockSound
  CheckerVanish CheckerFacts.
From Dyadel Require Import CheckerFactsSound CheckerTiesSound CheckerRing CheckerRingSound CheckerRow.
Import ListNotations.
Open Scope R_scope.

(* Both ends of a segment nearer to c than a point between them: there is none.
  P, Q, C: ends and c, seen from the point. *)
Lemma between_not_farther (ex ey px py qx qy cx cy : R) : ex <> 0 \/ ey <> 0 -> ex * py - ey * px = 0 ->
  ex * qy - ey * qx = 0 ->
  px * qx + py * qy < 0 -> px * px + py * py < 2 * (px * cx + py * cy) ->
    qx * qx + qy * qy < 2 * (qx * cx + qy * cy) -> False.
Proof.
  intros E P Q M A B. set (n := ex * ex + ey * ey).
  assert (N : 0 < n).
  { unfold n. pose proof (Rle_0_sqr ex) as Sx. pose proof (Rle_0_sqr ey) as Sy. unfold Rsqr in Sx, Sy.
    destruct (Req_dec (ex * ex + ey * ey) 0) as [Z | Z]; [| lra].
      destruct (Rplus_sqr_eq_0 ex ey) as [X Y]; [unfold Rsqr; lra |].
    destruct E; contradiction. }
  assert (PQ : px * qy - py * qx = 0).
  { apply Rmult_eq_reg_l with n; [| lra]. rewrite Rmult_0_r.
    transitivity ((ex * px + ey * py) * (ex * qy - ey * qx) - (ex * qx + ey * qy) * (ex * py - ey * px)); [unfold n;
      ring |].
    rewrite P, Q. ring. }
  assert (K : (px * px + py * py) * (qx * cx + qy * cy) = (px * qx + py * qy) * (px * cx + py * cy)).
  { transitivity ((px * qx + py * qy) * (px * cx + py * cy) + (px * qy - py * qx) * (px * cy - py * cx)); [ring |].
    rewrite PQ. ring. }
  pose proof (Rle_0_sqr px) as X1. pose proof (Rle_0_sqr py) as X2. pose proof (Rle_0_sqr qx) as X3.
    pose proof (Rle_0_sqr qy) as X4.
  unfold Rsqr in *. assert (Pc : 0 < px * cx + py * cy) by lra. assert (Qc : 0 < qx * cx + qy * cy) by lra.
  assert (0 <= (px * px + py * py) * (qx * cx + qy * cy)) by (apply Rmult_le_pos; lra).
  assert (0 < - (px * qx + py * qy) * (px * cx + py * cy)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

Section Sound.

Variable v : Z -> R.
Variable l : nat -> R.
Variable most u : Z.
Variable U : (0 < u)%Z.
Variable st : state.
Variable St : state_ok v l u st.
Variable hint : poly -> cofactor.
Variable sites : list site.
Variable B : nat -> rect.
Variable D : describes sites B.
Variable g : tied_row.
(* A choice, in which the members of the row are where the block says. *)
Variable p : nat -> point.
Variable P : choice (length sites) B p.
Variable At : forall k m, In m (row_members g) -> named sites k (fst m) -> p k = point_of v (snd m).

Let a := snd (one_end g).
Let b := snd (other_end g).
Notation ex := (dx v a b).
Notation ey := (dy v a b).

Lemma row_place i q : place_of (row_there sites g) i = Some q -> exists m,
  In m (row_members g) /\ fst m = i /\ snd m = q.
Proof.
  unfold place_of. destruct (find _ _) as [m |] eqn:F; [| discriminate]. intros E. injection E as <-.
  apply find_some in F as [M N]. apply Z.eqb_eq in N. apply filter_In in M as [M _]. now exists m.
Qed.

Lemma row_on_line m : fact_holds most u st hint (row_fact g) = true -> In m (row_members g) ->
  ex * (snd (point_of v (snd m)) - snd (point_of v a)) - ey * (fst (point_of v (snd m)) - fst (point_of v a)) = 0.
Proof.
  intros F M. destruct (fact_holds_ok v l most u U st St hint _ F) as [_ On]. destruct M as [<- | [<- | M]].
  - fold a. ring.
  - fold b. unfold dx, dy. ring.
  - exact (On (snd m) (in_map snd _ _ M)).
Qed.

(* Nobody is beyond the line, s: on which side all are. *)
Lemma row_weak s i j : (s = 1 \/ s = -1)%Z -> fact_holds most u st hint (row_fact g) = true ->
  all_beside most u st sites g s = true ->
  (exists m, In m (row_members g) /\ named sites i (fst m)) -> (exists m,
    In m (row_members g) /\ named sites j (fst m)) ->
  (ex <> 0 \/ ey <> 0) -> weak_edge (length sites) p i j.
Proof.
  intros S F E (mi & Mi & Ni) (mj & Mj & Nj) Nz. right. unfold all_beside in E. rewrite forallb_forall in E.
  exists (IZR s * ey, - IZR s * ex), (dot (IZR s * ey, - IZR s * ex) (point_of v a)).
  pose proof (row_on_line mi F Mi) as Oi. pose proof (row_on_line mj F Mj) as Oj.
  pose proof (At i mi Mi Ni) as Pi. pose proof (At j mj Mj Nj) as Pj. unfold dot at 1. cbn [fst snd].
    split; [| split].
  - intros Z. injection Z as Zx Zy. destruct S as [-> | ->]; destruct Nz as [N | N]; apply N; lra.
  - intros k _ [-> | ->]; [rewrite Pi | rewrite Pj]; unfold dot; cbn [fst snd]; destruct S as [-> | ->]; lra.
  - intros n Kn. unfold dot. cbn [fst snd].
    destruct (nth_error sites n) as [t |] eqn:T; [| apply nth_error_None in T; lia].
    specialize (E t (nth_error_In _ _ T)). apply orb_prop in E as [E | E].
    + apply existsb_exists in E as (m & M & Nm). apply Z.eqb_eq in Nm. rewrite (At n m M (ex_intro _ t (conj T Nm))).
      pose proof (row_on_line m F M). destruct S as [-> | ->]; lra.
    + apply Z.eqb_eq in E. destruct (D n t T) as (X0 & X1 & Y0 & Y1). destruct (P n Kn) as [Hx Hy].
      rewrite X0, X1 in Hx. rewrite Y0, Y1 in Hy. unfold side_of_row in E. cbv zeta in E.
      pose proof (cross_ok v l most u U st St _ _ _ _ _ _ _ _ (step_x_ok v l most u st St a b) (step_y_ok v l most u
        st St a b)
        (less_ok v l most u st St _ _ _ _ (side_known_ok l u U _ _ _ Hx) (number_at_ok v l u st St (at_first a)))
        (less_ok v l most u st St _ _ _ _ (side_known_ok l u U _ _ _ Hy) (number_at_ok v l u st St (at_second a))))
          as C.
      destruct S as [-> | ->]; [apply (sign_positive u U _ _ (proj1 C)) in E | apply (sign_negative u U _ _ (proj1
        C)) in E];
        unfold point_of; cbn [fst snd]; lra.
Qed.

Theorem row_tie_every_choice pairs e i j : In e pairs -> ~ In e (row_loose most u st hint sites g pairs) ->
  named sites i (from e) -> named sites j (to e) ->
  weak_edge (length sites) p i j /\ ~ strict_edge (length sites) p i j.
Proof.
  intros I H Ni Nj. unfold row_loose in H. destruct (is_free_row most u st hint sites g) eqn:E; [| contradiction].
  cbv zeta in H. match type of H with ~ In e (kept ?f pairs) => destruct (f e) eqn:K; [destruct H;
    now apply in_kept |] end.
  clear H. apply negb_false_iff in K. unfold row_tie in K.
  destruct (place_of (row_there sites g) (from e)) as [qi |] eqn:Fi; [| discriminate].
  destruct (place_of (row_there sites g) (to e)) as [qj |] eqn:Fj; [| discriminate].
  apply row_place in Fi as (mi & Mi & Ei & Qi). apply row_place in Fj as (mj & Mj & Ej & Qj).
  subst qi qj. rewrite <- Ei in Ni. rewrite <- Ej in Nj. apply andb_prop in E as [F E].
  assert (Nz : ex <> 0 \/ ey <> 0).
  { pose proof F as G. unfold row_fact in G. cbn [fact_holds] in G. apply andb_prop in G as [G _].
    apply orb_prop in G as [G | G].
    - left. exact (no_zero_ok l u U _ _ (step_x_ok v l most u st St a b) G).
    - right. exact (no_zero_ok l u U _ _ (step_y_ok v l most u st St a b) G). }
  split.
  - apply orb_prop in E as [E | E]; [apply (row_weak 1) | apply (row_weak (-1))]; auto; now exists mi + now exists mj.
  - intros (c & Eq & Out). apply existsb_exists in K as (m & M & K).
    rewrite !andb_true_iff, !negb_true_iff, !Z.eqb_neq in K.
    destruct K as [[Nmi Nmj] K]. apply filter_In in M as [M T]. apply existsb_exists in T as (t & It & Nt).
      apply Z.eqb_eq in Nt.
    apply In_nth_error in It as [k Kt]. assert (Nm : named sites k (fst m)) by (exists t; now split).
    rewrite <- Ei in Nmi. rewrite <- Ej in Nmj.
    pose proof (Out k (named_below _ _ _ Nm) (named_apart _ _ _ _ _ Nm Ni Nmi) (named_apart _ _ _ _ _ Nm Nj Nmj)) as
      Ck.
    apply dist_eq in Eq. apply dist_lt in Ck. rewrite (At i mi Mi Ni), ?(At j mj Mj Nj) in *.
      rewrite (At k m M Nm) in Ck.
    unfold is_between in K. apply Z.eqb_eq in K.
    pose proof (sum_with_ok v l most u st St _ _ _ _
      (product_with_ok v l most u U st St _ _ _ _ (step_x_ok v l most u st St (snd m) (snd mi)) (step_x_ok v l most
        u st St (snd m) (snd mj)))
      (product_with_ok v l most u U st St _ _ _ _ (step_y_ok v l most u st St (snd m) (snd mi)) (step_y_ok v l most
        u st St (snd m) (snd mj)))) as S.
    pose proof (sign_negative u U _ _ (proj1 S) K) as Neg.
    pose proof (row_on_line mi F Mi) as Oi. pose proof (row_on_line mj F Mj) as Oj.
      pose proof (row_on_line m F M) as Om.
    refine (between_not_farther ex ey _ _ _ _ (fst c - fst (point_of v (snd m))) (snd c - snd (point_of v (snd m)))
      Nz _ _ Neg _ _);
      unfold dx, dy, dist2 in *; lra.
Qed.

End Sound.

(* However narrower the rectangles are, as long as they hold the points that the block describes: the pair is possible,
   and not legal. *)
Theorem row_tie_stays v l most u st hint sites B B' g pairs e a b p : (0 < u)%Z -> state_ok v l u st ->
  describes sites B ->
  refined (length sites) B' B -> choice (length sites) B' p ->
  (forall k m, In m (row_members g) -> named sites k (fst m) -> p k = point_of v (snd m)) ->
  In e pairs -> ~ In e (row_loose most u st hint sites g pairs) -> named sites a (from e) -> named sites b (to e) ->
  possible (length sites) B' a b /\ ~ legal (length sites) B' a b.
Proof.
  intros U St D Q P At I H Na Nb. pose proof (named_below sites a (from e) Na) as Ka.
  pose proof (named_below sites b (to e) Nb) as Kb. apply (tied_by_choice _ B B' a b p Ka Kb Q P). intros P'.
  exact (row_tie_every_choice v l most u U st St hint sites B D g p P' At pairs e a b I H Na Nb).
Qed.
