(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* A chain of centres, endless on both sides, with all its parts blocked for two sites: if it crosses the segment
   between a point of one and a point of the other an odd number of times, their pair is not possible [CERT-4]. *)
From Coq Require Import Reals Lra Lia Psatz ZArith List Bool Classical.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation Path Winding Separated.
Import ListNotations.
Open Scope R_scope.

Lemma steps_last a l b : steps a (l ++ [b]) = steps a l ++ [(finish a l, b)].
Proof. revert a. induction l as [| c l IH]; intros a; [reflexivity |]. simpl. now rewrite IH. Qed.

Lemma finish_last a l b : finish a (l ++ [b]) = b.
Proof. revert a. induction l as [| c l IH]; intros a; [reflexivity |]. simpl. apply IH. Qed.

Lemma crossed_app p q E F : crossed p q (E ++ F) = xorb (crossed p q E) (crossed p q F).
Proof.
  induction E as [| e E IH]; [symmetry; apply xorb_false_l |]. unfold crossed in *. simpl app. cbn [fold_right].
  rewrite IH. symmetry. apply xorb_assoc.
Qed.

(* Between a point and itself nothing crosses. *)
Lemma crossed_nothing p E : crossed p p E = false.
Proof.
  unfold crossed. induction E as [| e E IH]; [reflexivity |]. simpl. rewrite IH. unfold crosses.
  assert (L : forall v, is_left p p v = true).
  { intros v. unfold is_left. replace (orient p p v) with 0 by (unfold orient; ring). destruct (Rle_dec 0 0);
    [reflexivity | lra]. }
  now rewrite !L.
Qed.

Lemma ray_crosses_nothing p g u : ray_crosses p p g u = false.
Proof.
  unfold ray_crosses. replace (turning (minus p p) u) with 0 by (unfold turning, minus; simpl; ring).
  destruct (Req_EM_T 0 0); [reflexivity | lra].
Qed.

Section Chain.
Variables (N : nat) (B : sites) (i j : nat).
Variables (I : (i < N)%nat) (J : (j < N)%nat).

(* Site k is surely nearer to c than both; it is beyond both in direction u. *)
Definition beaten (k : nat) (c : point) : Prop := dl c (B k) < ds c (B i) /\ dl c (B k) < ds c (B j).
Definition beyond_both (k : nat) (u : point) : Prop := forall y, inside y (B k) ->
  (forall x, inside x (B i) -> dot u x < dot u y) /\ (forall x, inside x (B j) -> dot u x < dot u y).

(* The chain: a ray from g in direction u0, links by their blockers and ends, a ray from the last end in direction u1.
  *)
Variables (u0 : point) (k0 : nat) (g : point) (l : list (nat * point)) (k1 : nat) (u1 : point).
Fixpoint held (a : point) (l : list (nat * point)) : Prop :=
  match l with [] => True | (k, b) :: r => (k < N)%nat /\ beaten k a /\ beaten k b /\ held b r end.
Definition stops : list point := map snd l.
Definition foot : point := finish g stops.
Definition chain_holds : Prop :=
  ((k0 < N)%nat /\ beaten k0 g /\ beyond_both k0 u0) /\ held g l /\ (k1 < N)%nat /\ beaten k1 foot /\ beyond_both k1 u1.
Definition crossings (p q : point) : bool :=
  xorb (ray_crosses p q g u0) (xorb (crossed p q (steps g stops)) (ray_crosses p q foot u1)).

Variable holds : chain_holds.

(* Its rays cut off. *)
Definition cut_chain (T : R) : list point := g :: stops ++ [out T foot u1].
Definition parts (T : R) : list (point * point) := steps (out T g u0) (cut_chain T).
Definition off (T : R) (z : point) : Prop := forall e, In e (parts T) -> ~ between z (fst e) (snd e).

Lemma parts_are T : parts T = (out T g u0, g) :: steps g stops ++ [(foot, out T foot u1)].
Proof. unfold parts, cut_chain. simpl. now rewrite steps_last. Qed.

Lemma ray_beaten T k c u : 0 <= T -> beaten k c -> beyond_both k u -> beaten k (out T c u).
Proof.
  intros P [X Y] F. split; apply closer_rect_ray; try assumption; intros y x Iy Ix; left;
    destruct (F y Iy) as [Fi Fj]; [now apply Fi | now apply Fj].
Qed.

Lemma beaten_between k a b z : beaten k a -> beaten k b -> between z a b -> beaten k z.
Proof. intros [A C] [A' C'] [t [T ->]]. split; now apply closer_rect_convex. Qed.

Lemma links_blocked a m e : held a m -> In e (steps a (map snd m)) -> exists k, (k < N)%nat /\ beaten k (fst e) /\
  beaten k (snd e).
Proof.
  revert a. induction m as [| [k b] m IH]; intros a H F; [destruct F |]. simpl in H, F. destruct H as (K & A & C & H).
  destruct F as [<- | F]; [now exists k | now apply (IH b)].
Qed.

Lemma parts_blocked T e : 0 <= T -> In e (parts T) -> exists k, (k < N)%nat /\ beaten k (fst e) /\ beaten k (snd e).
Proof.
  intros P F. destruct holds as ((K0 & G0 & F0) & H & K1 & G1 & F1). rewrite parts_are in F. destruct F as [<- | F].
  - exists k0. split; [exact K0 |]. split; [now apply ray_beaten | exact G0].
  - apply in_app_iff in F. destruct F as [F | [<- | []]]; [now apply (links_blocked g l) |].
    exists k1. split; [exact K1 |]. split; [exact G1 | now apply ray_beaten].
Qed.

Lemma pos_off T z : 0 <= T -> pos N B i z \/ pos N B j z -> off T z.
Proof.
  intros P H e F Bt. destruct (parts_blocked T e P F) as (k & K & A & C).
  destruct (beaten_between k _ _ z A C Bt) as [X Y]. destruct H as [H | H]; specialize (H k K); lra.
Qed.

Lemma inside_pos m z : inside z (B m) -> pos N B m z.
Proof.
  intros H k K. pose proof (ds_le z _ _ H) as D. rewrite dist_self in D. pose proof (dl_nonneg z (B k)). lra.
Qed.

(* ---- no way from p to q ---- *)

Section Way.
Variables p q : point.
Variable apart : p <> q.

Lemma range_mix K a b t : 0 <= t <= 1 -> in_range p q K a -> in_range p q K b -> in_range p q K (mix t a b).
Proof.
  intros T [A1 A2] [C1 C2]. unfold in_range. rewrite up_mix. unfold mix. cbn [fst snd].
  assert (G : forall x y, Rabs x <= K -> Rabs y <= K -> Rabs ((1 - t) * x + t * y) <= K).
  { intros x y X Y. pose proof (Rle_abs x). pose proof (Rle_abs (- x)) as Nx. rewrite Rabs_Ropp in Nx.
    pose proof (Rle_abs y). pose proof (Rle_abs (- y)) as Ny. rewrite Rabs_Ropp in Ny. apply Rabs_le. split; nra. }
  split; now apply G.
Qed.

Lemma range_all (way : list point) : exists K, forall z, In z way -> in_range p q K z.
Proof.
  induction way as [| z way [K H]]; [exists 0; now intros |].
  exists (Rmax K (Rmax (Rabs (fst (up p q z))) (Rabs (snd (up p q z))))).
  pose proof (Rmax_l K (Rmax (Rabs (fst (up p q z))) (Rabs (snd (up p q z))))).
  pose proof (Rmax_r K (Rmax (Rabs (fst (up p q z))) (Rabs (snd (up p q z))))).
  pose proof (Rmax_l (Rabs (fst (up p q z))) (Rabs (snd (up p q z)))).
  pose proof (Rmax_r (Rabs (fst (up p q z))) (Rabs (snd (up p q z)))).
  intros y [<- | Y]; [split; lra | destruct (H y Y); split; lra].
Qed.

Definition turns_of (T : R) (z : point) : Z :=
  around (goes_up p q u0) (goes_up p q u1) (up p q (out T g u0)) (map (up p q) (cut_chain T)) (up p q z).

Definition clear_ends (K T : R) : Prop := forall z, in_range p q K z ->
  clear_of (goes_up p q u0) (up p q (out T g u0)) (up p q z) /\ clear_of (goes_up p q u1) (up p q (out T foot u1)) (up
    p q z).

Lemma same_on_step K T a b : clear_ends K T -> in_range p q K a -> in_range p q K b ->
  (forall t, 0 <= t <= 1 -> off T (mix t a b)) -> turns_of T b = turns_of T a.
Proof.
  intros C A F Off. unfold turns_of. rewrite <- (mix_1 a b) at 1. rewrite <- (mix_0 a b) at 2. rewrite !up_mix.
  apply (around_steady (fun t => mix t (up p q a) (up p q b))).
  { unfold mix. split; cbn [fst snd]; apply derivable_continuous; reg. }
  intros t T01. rewrite <- up_mix. pose proof (range_mix K a b t T01 A F) as R. destruct (C _ R) as [C0 C1].
  rewrite finish_lifted. unfold cut_chain at 1. cbn [finish]. rewrite finish_last. split; [exact C0 |]. split;
    [exact C1 |].
  intros e E. rewrite steps_lifted in E. apply in_map_iff in E. destruct E as ([x y] & <- & E).
  intros [r [Rr Eq]]. apply (Off t T01 (x, y) E). exists r. split; [exact Rr |]. apply (up_injective p q apart).
  rewrite (up_mix p q r). exact Eq.
Qed.

Lemma same_on_way K T a way : clear_ends K T -> (forall z, In z (a :: way) -> in_range p q K z) ->
  (forall e, In e (steps a way) -> forall t, 0 <= t <= 1 -> off T (mix t (fst e) (snd e))) ->
  turns_of T (finish a way) = turns_of T a.
Proof.
  intros C. revert a. induction way as [| b way IH]; intros a R Off; [reflexivity |]. simpl.
  rewrite (IH b); [| intros z Z; apply R; now right | intros e E; apply Off; now right].
  apply (same_on_step K); [exact C | apply R; now left | apply R; right; now left |]. apply (Off (a, b)). now left.
Qed.

Theorem no_way way : crossings p q = true -> pos N B i p -> pos N B j q -> finish p way = q ->
  (forall T, 0 <= T -> forall e, In e (steps p way) -> forall t, 0 <= t <= 1 -> off T (mix t (fst e) (snd e))) -> False.
Proof.
  intros Cr Pp Pq End Off. destruct (range_all (p :: way)) as [K R].
  assert (Kp : in_range p q K p) by (apply R; now left).
  destruct holds as ((K0 & G0 & F0) & H & K1 & G1 & F1).
  assert (Dir : forall k u, beyond_both k u -> u <> (0, 0)).
  { intros k u F ->. destruct (F _ (nearest_inside (0, 0) (B k))) as [X _].
    specialize (X _ (nearest_inside (0, 0) (B i))). unfold dot in X. simpl in X. lra. }
  destruct (ray_cut p q apart K g u0 Kp (Dir _ _ F0)) as (T0 & P0 & C0).
  destruct (ray_cut p q apart K foot u1 Kp (Dir _ _ F1)) as (T1 & P1 & C1).
  set (T := Rmax T0 T1 + 1). pose proof (Rmax_l T0 T1). pose proof (Rmax_r T0 T1).
  destruct (C0 T ltac:(unfold T; lra)) as (E0 & _ & X0). destruct (C1 T ltac:(unfold T; lra)) as (E1 & X1 & _).
  assert (PT : 0 <= T) by (unfold T; lra).
  assert (Ends : clear_ends K T) by (intros z Z; split; [now apply E0 | now apply E1]).
  pose proof (same_on_way K T p way Ends R (Off T PT)) as Same. rewrite End in Same.
  assert (Level : forall h v, weighs h (up p q q) v = weighs h (up p q p) v) by (intros; unfold weighs, right;
    now rewrite up_level).
  unfold turns_of, around in Same. rewrite !Level, steps_lifted in Same. fold (parts T) in Same.
  pose proof (crossed_odd p q apart (parts T)) as Odd.
  replace (passes_all _ _ - passes_all _ _)%Z with 0%Z in Odd by lia.
  rewrite parts_are in Odd. unfold crossed in Odd at 1. cbn [fold_right fst snd] in Odd.
  fold (crossed p q (steps g stops ++ [(foot, out T foot u1)])) in Odd. rewrite crossed_app in Odd.
  unfold crossed in Odd at 2. cbn [fold_right fst snd] in Odd. rewrite X0, X1, xorb_false_r in Odd.
  unfold crossings in Cr. rewrite Cr in Odd. discriminate Odd. intros e E. rewrite <- parts_are in E.
  split; revert e E; apply pos_off; auto.
Qed.
End Way.

(* ---- the way through a centre at infinity ---- *)

Section Far.
Variables (c : nat -> point) (u : point) (m : R).
Variable chosen : choice N B c.
Variable across : empty_half_plane N c (pair i j) u m.

Lemma on_line : dot u (c i) = m /\ dot u (c j) = m.
Proof. destruct across as [_ [A _]]. split; apply A; try assumption; [now left | now right]. Qed.

Lemma out_height T x : dot u (out T x u) = dot u x + T * dot u u.
Proof. unfold dot, out. simpl. ring. Qed.

Lemma length_u : 0 < dot u u.
Proof.
  destruct across as [U _]. destruct u as [x y]. unfold dot. simpl. destruct (Req_dec x 0) as [-> | X]; [| nra].
  destruct (Req_dec y 0) as [-> | Y]; [now elim U | nra].
Qed.

Lemma out_pos v T : v = i \/ v = j -> 0 <= T -> pos N B v (out T (c v) u).
Proof.
  intros V P. assert (Iv : (v < N)%nat) by (destruct V as [-> | ->]; assumption).
  apply pos_exact; [exact Iv |]. exists c. split; [exact chosen |]. intros k K. apply dist_le.
  assert (E : dist2 (out T (c v) u) (c k) - dist2 (out T (c v) u) (c v) =
    dist2 (c v) (c k) + 2 * (T * (dot u (c v) - dot u (c k)))) by (unfold dist2, out, dot; simpl; ring).
  pose proof (dist2_nonneg (c v) (c k)). destruct across as [_ [_ G]]. specialize (G k K).
  assert (dot u (c v) = m) by (destruct on_line, V as [-> | ->]; assumption).
  assert (0 <= T * (dot u (c v) - dot u (c k))) by (apply Rmult_le_pos; lra). lra.
Qed.

(* On a line, a point beyond two points is farther from all between them than one of the two is. *)
Lemma beyond_on_line k w s : 0 <= s <= 1 -> dot u (c k) = m -> dot w (c i) < dot w (c k) -> dot w (c j) < dot w (c k) ->
  dist2 (mix s (c i) (c j)) (c k) < dist2 (mix s (c i) (c j)) (c i) ->
  dist2 (mix s (c i) (c j)) (c k) < dist2 (mix s (c i) (c j)) (c j) -> False.
Proof.
  intros S Hk Wi Wj. destruct on_line as [Hi Hj]. pose proof length_u as L.
  assert (Al : forall v, dot u v = m -> exists x, fst v = fst (c i) - x * snd u /\ snd v = snd (c i) + x * fst u).
  { intros v Hv. exists ((fst u * (snd v - snd (c i)) - snd u * (fst v - fst (c i))) / dot u u).
    assert (D : dot u v - dot u (c i) = 0) by lra. unfold dot in *.
    split; apply (Rmult_eq_reg_r (fst u * fst u + snd u * snd u)); try lra.
    - transitivity (fst (c i) * (fst u * fst u + snd u * snd u) - (fst u * (snd v - snd (c i)) - snd u * (fst v - fst
      (c i))) * snd u);
        [| field; lra].
      assert (X : fst u * (fst u * fst v + snd u * snd v - (fst u * fst (c i) + snd u * snd (c i))) = 0) by (rewrite
        D; ring). lra.
    - transitivity (snd (c i) * (fst u * fst u + snd u * snd u) + (fst u * (snd v - snd (c i)) - snd u * (fst v - fst
      (c i))) * fst u);
        [| field; lra].
      assert (X : snd u * (fst u * fst v + snd u * snd v - (fst u * fst (c i) + snd u * snd (c i))) = 0) by (rewrite
        D; ring). lra. }
  destruct (Al _ Hk) as (x & Kx & Ky). destruct (Al _ Hj) as (y & Jx & Jy).
  assert (Ei : dist2 (mix s (c i) (c j)) (c i) = s * y * (s * y) * dot u u) by (unfold dist2, mix, dot; simpl;
    rewrite Jx, Jy; ring).
  assert (Ej : dist2 (mix s (c i) (c j)) (c j) = (1 - s) * y * ((1 - s) * y) * dot u u)
    by (unfold dist2, mix, dot; simpl; rewrite Jx, Jy; ring).
  assert (Ek : dist2 (mix s (c i) (c j)) (c k) = (x - s * y) * (x - s * y) * dot u u)
    by (unfold dist2, mix, dot; simpl; rewrite Jx, Jy, Kx, Ky; ring).
  rewrite Ei, Ej, Ek. set (o := fst u * snd w - snd u * fst w).
  assert (Wk : 0 < x * o) by (unfold dot in Wi; rewrite Kx, Ky in Wi; unfold o; lra).
  assert (Wy : y * o < x * o) by (unfold dot in Wj; rewrite Kx, Ky, Jx, Jy in Wj; unfold o; lra).
  intros A C. apply (Rmult_lt_reg_r (dot u u)) in A; [| exact L]. apply (Rmult_lt_reg_r (dot u u)) in C; [| exact L].
  clearbody o. clear - S Wk Wy A C.
  assert (O : (0 < o /\ 0 < x /\ y < x) \/ (o < 0 /\ x < 0 /\ x < y)).
  { destruct (Rtotal_order o 0) as [O | [O | O]]; [right | subst o; lra | left]; repeat split; nra. }
  destruct O as [(_ & X & Y) | (_ & X & Y)].
  - destruct (Rle_dec 0 y) as [P | P].
    + assert (0 <= (1 - s) * y) by nra. assert ((1 - s) * y < x - s * y) by lra. nra.
    + assert (0 <= s * - y) by nra. assert (s * - y < x - s * y) by lra. nra.
  - destruct (Rle_dec y 0) as [P | P].
    + assert (0 <= (1 - s) * - y) by nra. assert ((1 - s) * - y < s * y - x) by lra. nra.
    + assert (0 <= s * y) by nra. assert (s * y < s * y - x) by lra. nra.
Qed.

Definition far_place (t s : R) : point := mix s (out t (c i) u) (out t (c j) u).

Lemma far_blocker k w : (k < N)%nat -> beyond_both k w ->
  exists t0, 0 <= t0 /\ forall t s, t0 <= t -> 0 <= s <= 1 -> ~ beaten k (far_place t s).
Proof.
  intros K F. destruct on_line as [Hi Hj]. destruct (across) as [_ [_ G]]. specialize (G k K).
  set (h := m - dot u (c k)). assert (Hh : 0 <= h) by (unfold h; lra).
  assert (Near : forall t s, beaten k (far_place t s) ->
    dist2 (mix s (c i) (c j)) (c k) + 2 * t * h < dist2 (mix s (c i) (c j)) (c i) /\
    dist2 (mix s (c i) (c j)) (c k) + 2 * t * h < dist2 (mix s (c i) (c j)) (c j)).
  { intros t s [X Y]. set (z := far_place t s) in *.
    assert (P : forall v, dist2 z v = dist2 (mix s (c i) (c j)) v + 2 * t * (m - dot u v) + t * t * dot u u).
    { intros v. replace m with (dot u (mix s (c i) (c j))) by (rewrite dot_mix, Hi, Hj; ring).
      unfold z, far_place, dist2, mix, out, dot. simpl. ring. }
    pose proof (le_dl z _ _ (chosen k K)). pose proof (ds_le z _ _ (chosen i I)). pose proof (ds_le z _ _ (chosen j J)).
    assert (A : dist z (c k) < dist z (c i)) by lra. assert (C : dist z (c k) < dist z (c j)) by lra.
    apply dist_lt in A, C. rewrite P, (P (c i)) in A. rewrite P, (P (c j)) in C. unfold h. rewrite Hi in A.
      rewrite Hj in C.
    set (x := dist2 (mix s (c i) (c j)) (c k)) in *. set (y := dist2 (mix s (c i) (c j)) (c i)) in *.
    set (v := dist2 (mix s (c i) (c j)) (c j)) in *. clearbody x y v. split; lra. }
  destruct (Req_dec h 0) as [Z | Z].
  - exists 0. split; [lra |]. intros t s T S Bt. destruct (Near t s Bt) as [X Y].
    rewrite Z, Rmult_0_r, Rplus_0_r in X, Y.
    destruct (F _ (chosen k K)) as [Fi Fj].
    apply (beyond_on_line k w s S); try assumption; [unfold h in Z; lra | apply Fi, chosen, I | apply Fj, chosen, J].
  - assert (P : 0 < h) by lra. pose proof (dist2_nonneg (c i) (c j)) as D. exists (dist2 (c i) (c j) / (2 * h)).
    split; [apply Rle_mult_inv_pos; lra |]. intros t s T S Bt. destruct (Near t s Bt) as [X _].
    apply (Rmult_le_compat_r (2 * h)) in T; [| lra]. unfold Rdiv in T. rewrite Rmult_assoc, Rinv_l in T by lra.
    assert (E : dist2 (mix s (c i) (c j)) (c i) = s * s * dist2 (c i) (c j)) by (unfold dist2, mix; simpl; ring).
    pose proof (dist2_nonneg (mix s (c i) (c j)) (c k)). rewrite E in X.
    assert (s * s * dist2 (c i) (c j) <= 1 * dist2 (c i) (c j)) by (apply Rmult_le_compat_r; [exact D | nra]). lra.
Qed.

Lemma heights (way : list point) : exists h, forall v, In v way -> dot u v <= h.
Proof.
  induction way as [| v way [h H]]; [exists 0; now intros |]. exists (Rmax h (dot u v)).
  pose proof (Rmax_l h (dot u v)). pose proof (Rmax_r h (dot u v)). intros x [<- | X]; [lra | specialize (H x X); lra].
Qed.

Lemma steps_ends a way e : In e (steps a way) -> In (fst e) (a :: way) /\ In (snd e) (a :: way).
Proof.
  revert a. induction way as [| b way IH]; intros a H; [destruct H |]. destruct H as [<- | H].
  - split; [now left | right; now left].
  - destruct (IH b H). split; now right.
Qed.

Lemma far_off : exists t, 0 <= t /\ forall T s, 0 <= T -> 0 <= s <= 1 -> off T (far_place t s).
Proof.
  destruct holds as ((K0 & G0 & F0) & _ & K1 & G1 & F1). destruct on_line as [Hi Hj]. pose proof length_u as L.
  destruct (far_blocker k0 u0 K0 F0) as (t0 & P0 & N0). destruct (far_blocker k1 u1 K1 F1) as (t1 & P1 & N1).
  destruct (heights (g :: stops)) as [h H].
  set (t2 := (Rabs (h - m) + 1) / dot u u). set (t := Rmax t2 (Rmax t0 t1)).
  assert (P2 : 0 <= t2) by (apply Rle_mult_inv_pos; [pose proof (Rabs_pos (h - m)); lra | exact L]).
  pose proof (Rmax_l t2 (Rmax t0 t1)) as Q2. pose proof (Rmax_r t2 (Rmax t0 t1)) as Q. pose proof (Rmax_l t0 t1).
    pose proof (Rmax_r t0 t1).
  fold t in Q2, Q. exists t. split; [lra |]. intros T s PT S e F Bt. rewrite parts_are in F. destruct F as [<- | F].
  - apply (N0 t s ltac:(lra) S). apply (beaten_between k0 _ _ _ (ray_beaten T k0 g u0 PT G0 F0) G0 Bt).
  - apply in_app_iff in F. destruct F as [F | [<- | []]].
    + destruct (steps_ends _ _ _ F) as [A C]. specialize (H _ A) as HA. specialize (H _ C) as HC.
      destruct Bt as [r [R0 E]]. assert (E' : dot u (far_place t s) = m + t * dot u u).
      { unfold far_place. rewrite dot_mix, !out_height, Hi, Hj. ring. }
      rewrite E, dot_mix in E'.
      assert (X : Rabs (h - m) + 1 <= t * dot u u).
      { apply (Rmult_le_compat_r (dot u u)) in Q2; [| lra]. unfold t2, Rdiv in Q2.
        rewrite Rmult_assoc, Rinv_l in Q2 by lra. lra. }
      pose proof (Rle_abs (h - m)). nra.
    + apply (N1 t s ltac:(lra) S). apply (beaten_between k1 _ _ _ G1 (ray_beaten T k1 foot u1 PT G1 F1) Bt).
Qed.
End Far.

(* ---- both kinds of centres ---- *)

Lemma inside_off T v x y : 0 <= T -> v = i \/ v = j -> inside x (B v) -> inside y (B v) ->
  forall t, 0 <= t <= 1 -> off T (mix t x y).
Proof.
  intros P V X Y t S. apply (pos_off T); [exact P |].
  assert (Q : pos N B v (mix t x y)) by (apply inside_pos, inside_convex; assumption).
  destruct V as [-> | ->]; [now left | now right].
Qed.

Lemma star_off T v z : 0 <= T -> v = i \/ v = j -> pos N B v z ->
  forall t, 0 <= t <= 1 -> off T (mix t z (nearest z (B v))).
Proof.
  intros P V X t S. apply (pos_off T); [exact P |].
  assert (Q : pos N B v (mix t z (nearest z (B v)))) by (apply pos_star; assumption).
  destruct V as [-> | ->]; [now left | now right].
Qed.

Theorem separated_impossible p q : inside p (B i) -> inside q (B j) -> crossings p q = true -> ~ possible N B i j.
Proof.
  intros Ip Iq Cr Po.
  assert (Apart : p <> q).
  { intros ->. unfold crossings in Cr. rewrite !ray_crosses_nothing, crossed_nothing in Cr. discriminate. }
  assert (Back : forall T a b, (forall t, 0 <= t <= 1 -> off T (mix t a b)) -> forall t, 0 <= t <= 1 -> off T (mix t b
    a)).
  { intros T a b H t S. rewrite mix_swap. apply H. lra. }
  pose proof (inside_pos i p Ip) as Pp. pose proof (inside_pos j q Iq) as Pq. destruct Po as [H | H].
  - apply (pair_possible N B i j I J) in H. destruct H as [z H].
    assert (Zi : pos N B i z) by (apply H; [exact I | now left]). assert (Zj : pos N B j z) by (apply H;
      [exact J | now right]).
    apply (no_way p q Apart [nearest z (B i); z; nearest z (B j); q] Cr Pp Pq eq_refl).
      intros T P e [<- | [<- | [<- | [<- | []]]]]; cbn [fst snd].
    + apply (inside_off T i); auto using nearest_inside.
    + apply Back, star_off; auto.
    + apply star_off; auto.
    + apply (inside_off T j); auto using nearest_inside.
  - apply (nerve_far N B (pair i j)) in H; [| exists i; split; [exact I | now left]].
    destruct H as (c & u & m & Ch & A).
    destruct (far_off c u m Ch A) as (t & Pt & Far).
    assert (Ray : forall T v, 0 <= T -> v = i \/ v = j -> forall s, 0 <= s <= 1 -> off T (mix s (c v) (out t (c v) u))).
    { intros T v P V s S. replace (mix s (c v) (out t (c v) u)) with (out (s * t) (c v) u) by (unfold mix, out;
      simpl; f_equal; ring).
      apply (pos_off T); [exact P |].
      assert (Q : pos N B v (out (s * t) (c v) u)) by (apply (out_pos c u m Ch A); [exact V | apply Rmult_le_pos; lra]).
      destruct V as [-> | ->]; [now left | now right]. }
    apply (no_way p q Apart [c i; out t (c i) u; out t (c j) u; c j; q] Cr Pp Pq eq_refl).
    intros T P e [<- | [<- | [<- | [<- | [<- | []]]]]]; cbn [fst snd].
    + apply (inside_off T i); auto.
    + apply Ray; auto.
    + intros s S. now apply (Far T s).
    + apply Back, Ray; auto.
    + apply (inside_off T j); auto.
Qed.
End Chain.
