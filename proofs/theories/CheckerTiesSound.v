(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* A pair that the checker shows to be a tie is weakly Delaunay for every choice, and strictly for none: however
   narrower the rectangles get, it stays possible, and never becomes legal. *)
From Coq Require Import Reals Lra Lia Psatz ZArith List Bool.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Checker CheckerSound CheckerFaces CheckerComplete.
From Dyadel Require Import CheckerCover CheckerCoverSound CheckerChainSound CheckerTies.
Import ListNotations.
Open Scope R_scope.

Lemma times_between w a b : (0 <= w)%Z -> (a <= b)%Z -> (times w a <= times w b)%Z.
Proof. intros. rewrite !times_value. now apply Z.mul_le_mono_nonneg_l. Qed.

Lemma near_covers g h b : covers h b -> ordered b -> (near g h <= near g b)%Z.
Proof.
  intros C [Ox Oy]. unfold near. cbv zeta. destruct (Z.ltb_spec 0 (sw g)) as [W | W].
  - destruct C as (X0 & X1 & Y0 & Y1). assert (W' : (0 <= sw g)%Z) by lia.
    pose proof (gap_covers _ _ _ _ (sx g) (times_between _ _ _ W' X0) (times_between _ _ _ W' Ox) (times_between _ _ _ W' X1)).
    pose proof (gap_covers _ _ _ _ (sy g) (times_between _ _ _ W' Y0) (times_between _ _ _ W' Oy) (times_between _ _ _ W' Y1)).
    nia.
  - destruct (heights_cover (sx g) (sy g) h b C). lia.
Qed.

(* ---- one centre ---- *)

(* A site that is not nearer than a in integers is not nearer. *)
Lemma spot_before S g a k A K x y : (0 <= sw g)%Z -> bounds S a A -> bounds S k K -> (far g a <= near g k)%Z ->
  inside x A -> inside y K -> level (of_spot g) (S * fst x, S * snd x) <= level (of_spot g) (S * fst y, S * snd y).
Proof.
  intros W Ha Hk H X Y. apply IZR_le in H. destruct (Z.eq_dec (sw g) 0) as [Z0 | Z0].
  - unfold far, near in H. rewrite Z0 in H. simpl in H. rewrite !opp_IZR in H. unfold bottom, top in H. rewrite !plus_IZR in H.
    destruct (Ha x X) as [Ax Ay]. destruct (Hk y Y) as [Kx Ky].
    pose proof (end_bound (sx g) _ _ _ Ax). pose proof (end_bound (sy g) _ _ _ Ay).
    pose proof (end_bound (sx g) _ _ _ Kx). pose proof (end_bound (sy g) _ _ _ Ky).
    unfold level, of_spot. simpl. rewrite Z0. lra.
  - assert (P : (0 < sw g)%Z) by lia. pose proof (far_bound S g a A x P Ha X). pose proof (near_bound S g k K y P Hk Y).
    apply IZR_lt in P. nra.
Qed.

Definition centre_of (S : R) (g : spot) : point := (IZR (sx g) / (IZR (sw g) * S), IZR (sy g) / (IZR (sw g) * S)).

Lemma level_dist2 S g x : 0 < S -> (0 < sw g)%Z ->
  IZR (sw g) * level (of_spot g) (S * fst x, S * snd x) + IZR (sx g) * IZR (sx g) + IZR (sy g) * IZR (sy g)
  = IZR (sw g) * IZR (sw g) * (S * S) * dist2 (centre_of S g) x.
Proof.
  intros P W. apply IZR_lt in W. unfold level, of_spot, dist2, centre_of. simpl. field. split; lra.
Qed.

Lemma before_dist S g x y : 0 < S -> (0 < sw g)%Z ->
  level (of_spot g) (S * fst x, S * snd x) <= level (of_spot g) (S * fst y, S * snd y) ->
  dist (centre_of S g) x <= dist (centre_of S g) y.
Proof.
  intros P W H. apply dist_le. pose proof (level_dist2 S g x P W) as X. pose proof (level_dist2 S g y P W) as Y.
  apply IZR_lt in W. assert (Q : 0 < IZR (sw g) * IZR (sw g) * (S * S)) by (repeat apply Rmult_lt_0_compat; assumption).
  apply (Rmult_le_reg_l _ _ _ Q). rewrite <- X, <- Y. apply (Rmult_le_compat_l (IZR (sw g))) in H; lra.
Qed.

(* No circle has i and j on it, or inside, and both k and l outside. *)
Lemma crossed_not_strict (u v s t : R) (a b k l c : point) : 0 <= s -> 0 <= t -> 0 < s + t -> u + v = s + t ->
  u * fst a + v * fst b = s * fst k + t * fst l -> u * snd a + v * snd b = s * snd k + t * snd l ->
  s * (fst k * fst k + snd k * snd k) + t * (fst l * fst l + snd l * snd l) <=
  u * (fst a * fst a + snd a * snd a) + v * (fst b * fst b + snd b * snd b) ->
  dist2 c a = dist2 c b -> dist2 c a < dist2 c k -> dist2 c a < dist2 c l -> False.
Proof.
  intros Hs Ht P W X Y Q E K L.
  assert (G : s * dist2 c k + t * dist2 c l <= u * dist2 c a + v * dist2 c b).
  { unfold dist2.
    assert (M : forall z : point, (fst c - fst z) * (fst c - fst z) + (snd c - snd z) * (snd c - snd z) =
      (fst z * fst z + snd z * snd z) - 2 * (fst c * fst z + snd c * snd z) + (fst c * fst c + snd c * snd c)) by (intros; ring).
    rewrite !M. clear M. apply (Rmult_eq_compat_l (fst c)) in X. apply (Rmult_eq_compat_l (snd c)) in Y.
    apply (Rmult_eq_compat_l (fst c * fst c + snd c * snd c)) in W. lra. }
  rewrite <- E in G. replace (u * dist2 c a + v * dist2 c a) with (s * dist2 c a + t * dist2 c a) in G
    by (rewrite <- !Rmult_plus_distr_r, W; reflexivity).
  destruct (Rle_lt_dec s 0) as [S0 | S0].
  - assert (s = 0) by lra. subst s. assert (t * dist2 c a < t * dist2 c l) by (apply Rmult_lt_compat_l; lra). lra.
  - assert (s * dist2 c a < s * dist2 c k) by (apply Rmult_lt_compat_l; lra).
    assert (t * dist2 c a <= t * dist2 c l) by (apply Rmult_le_compat_l; lra). lra.
Qed.

(* Where a point is in integers. *)
Lemma point_place S b A x : 0 < S -> is_box S b A -> is_point b = true -> inside x A ->
  fst x = IZR (x0 b) / S /\ snd x = IZR (y0 b) / S.
Proof.
  intros P (X0 & X1 & Y0 & Y1) H [X Y]. unfold is_point in H. rewrite andb_true_iff, !Z.eqb_eq in H. destruct H as [Hx Hy].
  rewrite <- Hx in X1. rewrite <- Hy in Y1.
  assert (xlo A = xhi A) by (apply (Rmult_eq_reg_r S); lra). assert (ylo A = yhi A) by (apply (Rmult_eq_reg_r S); lra).
  rewrite X0, Y0. split; field_simplify; lra.
Qed.

(* ---- ties ---- *)

Theorem tie_every_choice D E l edges B hint ties e a b p :
  check D E l edges = true -> describes l B -> In e ties -> ~ In e (loose_ties D E l hint ties) ->
  named l a (from e) -> named l b (to e) -> choice (length l) B p ->
  weak_edge (length l) p a b /\ ~ strict_edge (length l) p a b.
Proof.
  intros C F I H A G P. destruct (accepted_parts D E l edges C) as (bs & Sc & P0 & R0 & _).
  pose proof (unit_pos D E P0) as U. unfold loose_ties in H. rewrite Sc in H. cbv zeta in H.
  match type of H with ~ In e (kept ?f ties) => destruct (f e) eqn:K; [destruct H; now apply in_kept |] end.
  clear H. cbv beta in K. apply negb_false_iff, existsb_exists in K. destruct K as (h & _ & K). unfold check_tie in K.
  destruct (Map.find (from e) _) as [ba |] eqn:Fa; [| now rewrite andb_false_r in K].
  destruct (Map.find (to e) _) as [bb |] eqn:Fb; [| now rewrite andb_false_r in K].
  destruct (Map.find (near_side h) _) as [bk |] eqn:Fk; [| now rewrite andb_false_r in K].
  destruct (Map.find (far_side h) _) as [bl |] eqn:Fl; [| now rewrite andb_false_r in K].
  rewrite !andb_true_iff in K. destruct K as [[Ok Ol] [Cr Ec]].
  apply (sought_box D E l edges C bs Sc) in Fa, Fb, Fk, Fl.
  destruct (named_box D E l edges B C F bs Sc a _ A) as (ba' & _ & Fa' & _ & Pa).
  destruct (named_box D E l edges B C F bs Sc b _ G) as (bb' & _ & Fb' & _ & Pb).
  assert (ba' = ba) by congruence. assert (bb' = bb) by congruence. subst ba' bb'.
  destruct (found_box D E l edges B C F bs Sc _ _ Fa) as [Ba _]. destruct (found_box D E l edges B C F bs Sc _ _ Fb) as [Bb _].
  destruct (found_box D E l edges B C F bs Sc _ _ Fk) as [Bk _]. destruct (found_box D E l edges B C F bs Sc _ _ Fl) as [Bl _].
  destruct (found_named D E l edges B C F bs Sc _ _ Fa) as [_ Ka]. destruct (found_named D E l edges B C F bs Sc _ _ Fb) as [_ Kb].
  destruct (found_named D E l edges B C F bs Sc _ _ Fk) as [_ Kk]. destruct (found_named D E l edges B C F bs Sc _ _ Fl) as [_ Kl].
  set (k := position bs (near_side h)) in *. set (m := position bs (far_side h)) in *. rewrite Pa in Ka, Ba. rewrite Pb in Kb, Bb.
  split.
  - unfold on_empty_circle in Ec. cbv zeta in Ec. apply andb_true_iff in Ec. destruct Ec as [Ce Em].
    set (f := Z.max (far (about h) ba) (far (about h) bb)) in *.
    assert (W : (0 <= sw (about h))%Z).
    { unfold is_centre_of in Ce. destruct (Z.ltb_spec 0 (sw (about h))); [lia |]. apply andb_true_iff in Ce.
      destruct Ce as [Ce _]. apply Z.eqb_eq in Ce. lia. }
    assert (All : forall n, (n < length l)%nat ->
      level (of_spot (about h)) (unit D E * fst (p a), unit D E * snd (p a)) <=
      level (of_spot (about h)) (unit D E * fst (p n), unit D E * snd (p n)) /\
      level (of_spot (about h)) (unit D E * fst (p b), unit D E * snd (p b)) <=
      level (of_spot (about h)) (unit D E * fst (p n), unit D E * snd (p n)) /\
      exists bn, is_box (unit D E) bn (B n) /\ (f <= near (about h) bn)%Z).
    { intros n Kn. destruct (box_of D E l B F n Kn bs Sc P0) as (sn & bn & _ & Tn & _ & Bn & _).
      assert (M : (f <=? near (about h) bn)%Z = true).
      { refine (everywhere D E l edges B C F bs Sc _ _ _ Em bn (nth_error_In _ _ Tn)).
        intros q r Q O T. apply Z.leb_le in T. apply Z.leb_le. pose proof (near_covers (about h) q r Q O). lia. }
      apply Z.leb_le in M. split; [| split; [| now exists bn]].
      - apply (spot_before (unit D E) (about h) ba bn (B a) (B n)); try assumption; try (now apply exact_bounds);
          [unfold f in M; lia | now apply P | now apply P].
      - apply (spot_before (unit D E) (about h) bb bn (B b) (B n)); try assumption; try (now apply exact_bounds);
          [unfold f in M; lia | now apply P | now apply P]. }
    pose proof (All a Ka) as (_ & Eba & ga & Ga & Na). pose proof (All b Kb) as (Eab & _).
    unfold is_centre_of in Ce. destruct (Z.ltb_spec 0 (sw (about h))) as [Wp | Wz].
    + left. exists (centre_of (unit D E) (about h)), (dist (centre_of (unit D E) (about h)) (p a)). split; [| split].
      * apply Z.ltb_lt in Ce. pose proof (near_bound (unit D E) (about h) ga (B a) (p a) Wp (exact_bounds _ _ _ Ga U) (P a Ka)) as Nb.
        rewrite (level_dist2 _ _ _ U Wp) in Nb. assert (0 < IZR (near (about h) ga)) by (apply IZR_lt; lia).
        destruct (Req_dec (dist (centre_of (unit D E) (about h)) (p a)) 0) as [Z0 | Z0].
        -- rewrite <- dist_sq, Z0 in Nb. lra.
        -- pose proof (dist_nonneg (centre_of (unit D E) (about h)) (p a)). lra.
      * intros i Ki [-> | ->]; [reflexivity |].
        apply Rle_antisym; now apply before_dist.
      * intros n Kn. apply before_dist; [exact U | exact Wp |]. now destruct (All n Kn).
    + right. apply andb_true_iff in Ce. destruct Ce as [W0 Nz]. apply Z.eqb_eq in W0.
      exists (IZR (sx (about h)), IZR (sy (about h))), (dot (IZR (sx (about h)), IZR (sy (about h))) (p a)).
      assert (Lv : forall x y, level (of_spot (about h)) (unit D E * fst x, unit D E * snd x) <=
        level (of_spot (about h)) (unit D E * fst y, unit D E * snd y) ->
        dot (IZR (sx (about h)), IZR (sy (about h))) y <= dot (IZR (sx (about h)), IZR (sy (about h))) x).
      { intros x y Q. unfold level, of_spot in Q. simpl in Q. rewrite W0 in Q. unfold dot. simpl.
        apply (Rmult_le_reg_l (unit D E)); [exact U | lra]. }
      split; [| split].
      * intros Q. injection Q as Qx Qy. apply eq_IZR in Qx, Qy. rewrite Qx, Qy in Nz. discriminate.
      * intros i Ki [-> | ->]; [reflexivity |]. apply Rle_antisym; now apply Lv.
      * intros n Kn. apply Lv. now destruct (All n Kn).
  - intros (c & Eq & Out). unfold are_crossed in Cr. cbv zeta in Cr. rewrite !andb_true_iff, !Z.leb_le, Z.ltb_lt, !Z.eqb_eq in Cr.
    destruct Cr as [[[[[[[[[[Ia Ib] Ik] Il] Hs] Ht] Hp] Hw] Hx] Hy] Hq].
    unfold is_other in Ok, Ol. rewrite andb_true_iff, !negb_true_iff, !Z.eqb_neq in Ok, Ol.
    assert (Diff : forall i j bi bj, find_box bs i = Some bi -> find_box bs j = Some bj -> i <> j -> position bs i <> position bs j).
    { intros i j bi bj Qi Qj N Q. destruct (position_found bs i bi Qi) as [Ti Ni]. destruct (position_found bs j bj Qj) as [Tj Nj].
      rewrite Q in Ti. congruence. }
    assert (Nka : k <> a) by (rewrite <- Pa; apply (Diff _ _ _ _ Fk Fa); tauto).
    assert (Nkb : k <> b) by (rewrite <- Pb; apply (Diff _ _ _ _ Fk Fb); tauto).
    assert (Nla : m <> a) by (rewrite <- Pa; apply (Diff _ _ _ _ Fl Fa); tauto).
    assert (Nlb : m <> b) by (rewrite <- Pb; apply (Diff _ _ _ _ Fl Fb); tauto).
    pose proof (Out k Kk Nka Nkb) as Ck. pose proof (Out m Kl Nla Nlb) as Cl.
    apply dist_eq in Eq. apply dist_lt in Ck, Cl.
    destruct (point_place _ _ _ _ U Ba Ia (P a Ka)) as [Ax Ay]. destruct (point_place _ _ _ _ U Bb Ib (P b Kb)) as [Bx By].
    destruct (point_place _ _ _ _ U Bk Ik (P k Kk)) as [Kx Ky]. destruct (point_place _ _ _ _ U Bl Il (P m Kl)) as [Lx Ly].
    unfold square_of in Hq. apply (f_equal IZR) in Hw, Hx, Hy. apply IZR_le in Hs, Ht, Hq. apply IZR_lt in Hp.
    rewrite ?plus_IZR, ?mult_IZR in *. rewrite ?plus_IZR, ?mult_IZR in Hq.
    set (V := / unit D E) in *. unfold Rdiv in Ax, Ay, Bx, By, Kx, Ky, Lx, Ly. fold V in Ax, Ay, Bx, By, Kx, Ky, Lx, Ly.
    refine (crossed_not_strict (IZR (weight_from h)) (IZR (weight_to h)) (IZR (weight_near h)) (IZR (weight_far h))
      (p a) (p b) (p k) (p m) c Hs Ht Hp Hw _ _ _ Eq Ck Cl); rewrite ?Ax, ?Ay, ?Bx, ?By, ?Kx, ?Ky, ?Lx, ?Ly.
    + apply (Rmult_eq_compat_r V) in Hx. lra.
    + apply (Rmult_eq_compat_r V) in Hy. lra.
    + assert (0 <= V * V) by apply Rle_0_sqr. apply (Rmult_le_compat_r (V * V)) in Hq; [| assumption]. lra.
Qed.

(* A pair that is an edge weakly, and not strictly, by one choice in narrower rectangles: it is possible there, and not
   legal. *)
Lemma tied_by_choice n B B' a b p : (a < n)%nat -> (b < n)%nat -> refined n B' B -> choice n B' p ->
  (choice n B p -> weak_edge n p a b /\ ~ strict_edge n p a b) -> possible n B' a b /\ ~ legal n B' a b.
Proof.
  intros Ka Kb Q P H. assert (P' : choice n B p) by (intros k K; apply (Q k K), P, K). destruct (H P') as [W N]. split.
  - apply possible_exact; try assumption. now exists p.
  - intros L. apply N. now apply (legal_sound _ B' a b p Ka Kb L).
Qed.

(* However narrower the rectangles are, the pair is possible, and not legal. *)
Theorem tie_stays D E l edges B B' hint ties e a b :
  check D E l edges = true -> describes l B -> In e ties -> ~ In e (loose_ties D E l hint ties) ->
  named l a (from e) -> named l b (to e) -> refined (length l) B' B ->
  possible (length l) B' a b /\ ~ legal (length l) B' a b.
Proof.
  intros C F I H A G Q.
  assert (Ka : (a < length l)%nat) by (destruct A as [s [A _]]; apply nth_error_Some; congruence).
  assert (Kb : (b < length l)%nat) by (destruct G as [s [G _]]; apply nth_error_Some; congruence).
  set (p := fun k => nearest (0, 0) (B' k)). assert (P : choice (length l) B' p) by apply choice_nearest.
  apply (tied_by_choice _ B B' a b p Ka Kb Q P). intros P'. now apply (tie_every_choice D E l edges B hint ties e).
Qed.
